# Sourced by tools/run, tools/test and .ci/run: packages, configuration and build of this tree, told in short lines on
# stderr. The caller sets `root`, the top of the tree.
#
# Only what bash, coreutils, findutils, util-linux and dpkg offer may be used here: a bare Debian 12 has no more.

readonly kSetupFailed=10  # exit code of a failed set-up; 0 to 5 belong to the lekalo command
readonly kBuild="$root/build/release"
readonly kSetup="$root/build/setup"
readonly kMegabytesToBuild=300  # a build with tests takes about 100

say() { printf 'lekalo: %s\n' "$*" >&2; }

# fail REASON REMEDY...
fail() {
  printf 'lekalo: cannot go on: %s\n' "$1" >&2
  shift
  local remedy
  for remedy in "$@"; do printf 'lekalo:   %s\n' "$remedy" >&2; done
  exit $kSetupFailed
}

# Free megabytes where PATH (or its nearest existing parent) lies.
free_megabytes() {
  local path=$1
  while [[ ! -e $path ]]; do path=${path%/*}; [[ -n $path ]] || path=/; done
  df --output=avail --block-size=1M -- "$path" | tail -n 1 | tr -d ' '
}

# ---------------------------------------------------------------------------------------------------- packages

# Names of the packages of the given sections, one a line.
packages_of() {
  local section package rest wanted
  while read -r section package rest; do
    for wanted in "$@"; do [[ $section != "$wanted" ]] || printf '%s\n' "$package"; done
  done <"$root/tools/packages"
}

# Those of them that are not installed. dpkg is asked once for all.
missing_packages() {
  local names package status
  local -A installed=()
  mapfile -t names < <(packages_of "$@")
  while read -r package status; do
    [[ $status != installed ]] || installed[$package]=1
  done < <(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "${names[@]}" 2>/dev/null)
  for package in "${names[@]}"; do [[ -n ${installed[$package]:-} ]] || printf '%s\n' "$package"; done
}

# True if all packages of the sections are installed. A stamp remembers a yes until the list or dpkg's state changes:
# a few stat calls instead of a question to dpkg.
packages_are_there() {
  local stamp="$kSetup/packages-$*"
  stamp=${stamp// /-}
  [[ $stamp -nt $root/tools/packages && $stamp -nt /var/lib/dpkg/status ]] && return 0
  [[ -z $(missing_packages "$@") ]] || return 1
  { mkdir -p "$kSetup" && : >"$stamp"; } 2>/dev/null || true
}

distribution() {
  local ID='' VERSION_ID='' PRETTY_NAME='an unknown system'
  [[ ! -r /etc/os-release ]] || . /etc/os-release
  printf '%s %s %s\n' "${ID:-unknown}" "${VERSION_ID:-unknown}" "$PRETTY_NAME"
}

# The right to install: root itself, or sudo (asking for a password only if someone can type one).
as_root=()
require_root() {
  local -a missing=("$@")
  (( EUID != 0 )) || return 0
  local -a ask=(sudo -n true)
  [[ ! -t 2 ]] || ask=(sudo -v)
  if command -v sudo >/dev/null && "${ask[@]}" 2>/dev/null; then
    as_root=(sudo)
    return 0
  fi
  fail "packages are missing and user '$(id -un)' may not install them (not root, and sudo does not let it)." \
    "Ask an administrator to run:" \
    "apt-get install --no-install-recommends ${missing[*]}"
}

apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get --quiet --assume-yes \
    -o Acquire::Retries=3 -o Acquire::http::Timeout=30 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"
}

# Says why apt failed, from its log, in words that name the remedy.
explain_apt_failure() {
  local log=$1
  local no_network='Temporary failure resolving|Could not resolve|Could not connect|Cannot initiate the connection|Network is unreachable|Connection (timed out|refused|failed)|Failed to fetch|Unable to connect'
  if grep -qE 'No space left on device|enough free space' "$log"; then
    fail "the disk is full: packages could not be unpacked ($(free_megabytes /usr) MB free under /usr)." \
      "Free some space (about 1500 MB is enough) and start the same command again."
  elif grep -qE 'Could not get lock|Unable to acquire the dpkg' "$log"; then
    fail "another program is installing packages and has not finished within five minutes." \
      "Wait for it (or end it) and start the same command again."
  elif grep -qE "$no_network" "$log"; then
    fail "no network: Debian's package server cannot be reached." \
      "Connect the machine (behind a proxy: set http_proxy, and https_proxy), or install these packages by other means:" \
      "$(missing_packages "${sections[@]}" | tr '\n' ' ')" \
      "apt said: $(grep -m 1 -E "$no_network" "$log")"
  elif grep -qE 'dpkg was interrupted' "$log"; then
    fail "an earlier installation on this machine was interrupted." "Run: dpkg --configure -a (as root), then the same command again."
  elif grep -qE 'Unable to locate package|has no installation candidate' "$log"; then
    fail "Debian's package list does not have all that is needed: $(grep -m 1 -E '^E: ' "$log")" \
      "Check that /etc/apt/sources.list (or sources.list.d) has: deb http://deb.debian.org/debian bookworm main"
  elif grep -qE 'Permission denied|are you root' "$log"; then
    fail "no rights: apt-get may not install packages here." "Run as root, or as a user whom sudo lets run apt-get."
  fi
  tail -n 20 "$log" >&2
  fail "apt-get could not install the packages (its last lines are above)." "The whole log: $log"
}

install_packages() {
  local -a sections=("$@") missing  # sections: read by explain_apt_failure
  mapfile -t missing < <(missing_packages "$@")

  local id version name
  read -r id version name < <(distribution)
  if [[ $id != debian || $version != 12 ]] || ! command -v apt-get >/dev/null; then
    fail "wrong distribution: this is $name, and these packages of Debian 12 are missing: ${missing[*]}" \
      "Use a Debian 12 machine or container, for instance:" \
      "docker run -it -v '$root':/lekalo -w /lekalo debian:12 tools/run --help" \
      "Or install what answers to them here and build by hand: cmake --preset release && cmake --build --preset release"
  fi
  require_root "${missing[@]}"

  local log="$kSetup/apt.log"
  say "installing missing packages: ${missing[*]}"
  if ! apt_get update >"$log" 2>&1; then explain_apt_failure "$log"; fi

  # apt checks the space for the downloads but not for what they unpack to.
  local plan fetch unpack need free
  plan=$(apt_get install --no-install-recommends --simulate -o Debug::NoLocking=1 "${missing[@]}" 2>>"$log" | grep -c '^Inst ') ||
    explain_apt_failure "$log"
  fetch=$(apt_get install --no-install-recommends --print-uris "${missing[@]}" 2>>"$log" |
    { total=0; while read -r uri _ size _; do [[ $uri != \'* ]] || total=$((total + size)); done; echo $((total / 1000000 + 1)); })
  unpack=$((fetch * 5))  # Debian's archives unpack to four to five times their size
  need=$((unpack + fetch))
  free=$(free_megabytes /usr)
  (( free > need )) || fail "the disk is full: the packages need about $need MB under /usr, $free MB are free." \
    "Free some space and start the same command again."
  say "packages with what they need: $plan; to fetch: $fetch MB"
  apt_get install --no-install-recommends "${missing[@]}" >>"$log" 2>&1 </dev/null || explain_apt_failure "$log"
}

# ensure_packages SECTION...: installs what is missing of the sections.
ensure_packages() {
  packages_are_there "$@" && return 0
  make_folder "$kSetup"
  install_packages "$@"
  packages_are_there "$@" || fail "apt-get succeeded, but these packages are still missing: $(missing_packages "$@" | tr '\n' ' ')" \
    "The whole log: $kSetup/apt.log"
}

# ------------------------------------------------------------------------------------------------------- build

make_folder() {
  { mkdir -p "$1" && [[ -w $1 ]]; } 2>/dev/null && return 0
  (( $(free_megabytes "$1") > 0 )) || fail "the disk is full: the folder $1 cannot be made." "Free some space and start the same command again."
  fail "no rights: user '$(id -un)' cannot write to $1 (it belongs to $(stat -c %U "$root"))." \
    "Take the folder over (chown -R $(id -un) '$root', as root), or use a copy of your own."
}

# Only one set-up at a time works on this tree; a second one waits.
lock_tree() {
  make_folder "$kSetup"
  exec {lock}>"$kSetup/lock" || fail "cannot write to $kSetup." "Take the folder over or use a copy of your own."
  if ! flock --nonblock "$lock"; then
    say "waiting for another build of this tree"
    flock "$lock"
  fi
}
unlock_tree() { exec {lock}>&-; }

# logged LOG COMMAND...: on a terminal the output is shown, else it goes to the log; stdout stays free for the product.
logged() {
  local log=$1
  shift
  if [[ -t 2 ]]; then "$@" >&2; else "$@" >"$log" 2>&1; fi
}

# explain_build_failure WHAT LOG
explain_build_failure() {
  local what=$1 log=$2 first
  if [[ ! -t 2 && -s $log ]]; then
    first=$(grep -n -m 1 -E 'FAILED:|CMake Error' "$log" | cut -d : -f 1)
    tail -n "+${first:-1}" "$log" | head -n 60 >&2
  fi
  if (( $(free_megabytes "$kBuild") < 20 )) || grep -qs 'No space left on device' "$log"; then
    fail "the disk is full: $what stopped ($(free_megabytes "$kBuild") MB free in $root)." \
      "Free some space (about $kMegabytesToBuild MB are needed) and start the same command again: it goes on where it stopped."
  elif grep -qsE 'Killed signal|virtual memory exhausted|Cannot allocate memory' "$log"; then
    fail "the compiler ran out of memory." "Close other programs, or build with fewer jobs: CMAKE_BUILD_PARALLEL_LEVEL=1 and the same command."
  fi
  fail "$what failed (the messages are above)." "If you did not change the sources: remove $root/build and start the same command again."
}

# As many compilers as there are cores, each with 1.5 GB of memory.
build_jobs() {
  if [[ -n ${CMAKE_BUILD_PARALLEL_LEVEL:-} ]]; then echo "$CMAKE_BUILD_PARALLEL_LEVEL"; return; fi
  local cores key value rest jobs
  cores=$(nproc)
  jobs=$cores
  while read -r key value rest; do
    [[ $key != MemAvailable: ]] || jobs=$((value / 1500000))
  done 2>/dev/null </proc/meminfo || true
  (( jobs >= 1 )) || jobs=1
  echo $((jobs < cores ? jobs : cores))
}

# configure [-DNAME=VALUE...]: if never done, made for another place, or asked for another setting.
configure() {
  local cache="$kBuild/CMakeCache.txt" needed='' fresh=() setting
  if [[ ! -e $kBuild/build.ninja || $root/CMakePresets.json -nt $kBuild/build.ninja ]]; then needed=1; fi
  if [[ -e $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    needed=1
    fresh=(--fresh)
    say "this tree was moved or copied: configuring anew"
  fi
  for setting in "$@"; do
    setting=${setting#-D}
    grep -qsE "^${setting%%=*}:[A-Z]*=${setting#*=}\$" "$cache" || needed=1
  done
  [[ -n $needed ]] || return 0
  if [[ ! -e $cache ]]; then
    local free
    free=$(free_megabytes "$kBuild")
    (( free > kMegabytesToBuild )) || fail "the disk is full: a build needs about $kMegabytesToBuild MB, $free MB are free in $root." \
      "Free some space and start the same command again."
  fi
  make_folder "$kBuild"
  say "configuring build/release"
  (cd "$root" && logged "$kBuild/configure.log" cmake --preset release "${fresh[@]}" "$@") ||
    explain_build_failure "configuring" "$kBuild/configure.log"
}

# build TARGET
build() {
  local jobs
  jobs=$(build_jobs)
  # Objects of other copies of this tree can be taken from ccache: paths are seen relative to the tree.
  export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR:-1}
  logged "$kBuild/build.log" cmake --build "$kBuild" --parallel "$jobs" --target "$1" ||
    explain_build_failure "the build" "$kBuild/build.log"
}
