#!/bin/bash
# The decisions of tools/setup.sh and tools/run, on a scratch tree, with stand-ins for apt-get, dpkg-query, df, sudo, cmake.
# The stand-ins play what Debian 12's own programs were seen to print in each situation.
set -uo pipefail
tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$(mktemp -d)
chmod 755 "$scratch"
trap 'rm -rf "$scratch"' EXIT
passed=0
failed=0

# A fresh tree with the scripts, and stand-ins: everything is installed, the disk is large, the build succeeds.
fresh_tree() {
  rm -rf "${scratch:?}"/{tree,bin} "$scratch"/*.out
  mkdir -p "$scratch"/tree/{tools/lekalo,cmake,geometry,render} "$scratch/bin"
  cp "$tree"/tools/{run,test,setup.sh,packages} "$scratch/tree/tools/"
  touch "$scratch"/tree/{CMakeLists.txt,CMakePresets.json}
  stand_in dpkg-query 'for name; do case $name in -*) ;; *) echo "$name installed" ;; esac; done'
  stand_in df 'echo Avail; echo 50000'
  stand_in sudo 'exit 1'
  stand_in apt-get "echo \"\$*\" >>$scratch/apt.out"
  stand_in nproc 'echo 2'
  stand_in cmake "
    echo \"\$*\" >>$scratch/cmake.out
    mkdir -p build/release/bin
    case \$* in
      --preset*) echo 'CMAKE_HOME_DIRECTORY:INTERNAL=$scratch/tree' >build/release/CMakeCache.txt; touch build/release/build.ninja ;;
      --build*) printf '#!/bin/bash\nprintf \"<%%s>\" \"\$PWD\" \"\$@\"\nexit 3\n' >$scratch/tree/build/release/bin/lekalo
                chmod +x $scratch/tree/build/release/bin/lekalo
                mkdir -p $scratch/tree/build/release/lib/lekalo; touch $scratch/tree/build/release/lib/lekalo/lekalo_oiio.so ;;
    esac"
}

# stand_in NAME SCRIPT
stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" >"$scratch/bin/$1"
  chmod 755 "$scratch/bin/$1"
}

# in_setup COMMANDS: runs them with tools/setup.sh loaded, on a Debian 12 (unless DISTRIBUTION says otherwise), as root or
# as a user whose sudo is the stand-in.
in_setup() {
  PATH="$scratch/bin:$PATH" bash -c '
    set -euo pipefail
    root=$1
    . "$root/tools/setup.sh"
    distribution() { echo "${DISTRIBUTION:-debian 12 Debian GNU/Linux 12 (bookworm)}"; }
    require_root() { :; }
    eval "$2"' setup "$scratch/tree" "$1" >"$scratch/result.out" 2>&1 </dev/null
}

run() { (cd "$scratch" && PATH="$scratch/bin:$PATH" "$scratch/tree/tools/run" "$@") >"$scratch/result.out" 2>"$scratch/error.out" </dev/null; }

# expect NAME CODE EXPECTED_CODE PATTERN...: all patterns in the output, `!PATTERN` in no line of it.
expect() {
  local name=$1 code=$2 expected=$3 output pattern bad=''
  shift 3
  output=$(cat "$scratch"/{result,error}.out 2>/dev/null)
  (( code == expected )) || bad="exit code $code, expected $expected"
  for pattern in "$@"; do
    if [[ $pattern == !* ]]; then
      [[ $output != *"${pattern#!}"* ]] || bad="output has '${pattern#!}'"
    else
      [[ $output == *"$pattern"* ]] || bad="output lacks '$pattern'"
    fi
  done
  if [[ -z $bad ]]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'FAILED %s: %s\n%s\n' "$name" "$bad" "$output"
  fi
}

readonly kNothingInstalled='exit 1'

fresh_tree
run render a.yaml "two words"
expect 'first run builds, keeps folder, arguments and exit code' $? 3 "<$scratch><render><a.yaml><two words>" 'configuring' 'building'
run again
expect 'second run only runs' $? 3 '<again>' '!building' '!configuring'
calls=$(wc -l <"$scratch/cmake.out")
[[ $calls == 2 ]]
expect 'one configuration, one build' $? 0

sleep 0.01
touch "$scratch/tree/geometry/new.cpp"
run
expect 'a new file is built' $? 3 'building'
run
expect '... once' $? 3 '!building'
rm "$scratch/tree/geometry/new.cpp"
run
expect 'a removed file is seen' $? 3 'building'
sleep 0.01
touch "$scratch/tree/CMakePresets.json"
run
expect 'changed presets are configured' $? 3 'configuring'
rm "$scratch/tree/build/release/bin/lekalo"
run
expect 'a removed program is built again' $? 3 'building'

rm "$scratch/tree/build/release/lib/lekalo/lekalo_oiio.so"
run
expect 'a removed module is built again' $? 3 'building'
run
expect '... once' $? 3 '!building'

ln -sf "$scratch/tree/tools/run" "$scratch/link"
(cd / && PATH="$scratch/bin:$PATH" "$scratch/link" x) >"$scratch/result.out" 2>"$scratch/error.out"
expect 'through a symbolic link, from elsewhere' $? 3 '</><x>'

sed -i 's|=.*|=/somewhere/else|' "$scratch/tree/build/release/CMakeCache.txt"
touch "$scratch/tree/CMakeLists.txt"
run
expect 'a copied tree is configured anew' $? 3 'moved or copied' 'configuring'
grep -q -- --fresh "$scratch/cmake.out"
expect '... from nothing' $? 0

fresh_tree
stand_in cmake 'echo "FAILED: x.o"; echo "x.cpp:1:1: error: expected"; exit 1'
run
expect 'a failed build shows its errors' $? 10 'x.cpp:1:1: error: expected' 'failed'
fresh_tree
stand_in cmake 'case $* in --build*) echo "FAILED: x.o"; echo "No space left on device"; exit 1 ;; *) mkdir -p build/release; touch build/release/build.ninja ;; esac'
run
expect 'a build that fills the disk' $? 10 'the disk is full' 'goes on where it stopped'
fresh_tree
stand_in cmake 'case $* in --build*) echo "FAILED: x.o"; echo "c++: fatal error: Killed signal terminated program cc1plus"; exit 1 ;; *) touch build/release/build.ninja ;; esac'
run
expect 'a build that runs out of memory' $? 10 'ran out of memory' 'CMAKE_BUILD_PARALLEL_LEVEL=1'
fresh_tree
stand_in df 'echo Avail; echo 300'
run
expect 'too little space to begin' $? 10 'the disk is full' '300 MB are free'

fresh_tree
stand_in dpkg-query 'for name; do case $name in -*) ;; cmake | libfmt-dev) echo "$name not-installed" ;; *) echo "$name installed" ;; esac; done'
in_setup 'missing_packages product; is=$(packages_are_there product && echo there || echo not); echo "$is"'
expect 'only what is missing' $? 0 cmake libfmt-dev not '!embree'

fresh_tree
stand_in dpkg-query "[[ -e $scratch/tree/installed ]] || exit 1; for name; do echo \"\$name installed\"; done"
stand_in apt-get "
  echo \"\$*\" >>$scratch/apt.out
  case \$* in
    *--simulate*) echo 'Inst cmake (3.25.1)'; echo 'Inst cmake-data (3.25.1)' ;;
    *--print-uris*) echo \"'http://deb.debian.org/cmake.deb' cmake.deb 8000000 SHA256:0\" ;;
    *install*) touch $scratch/tree/installed ;;
  esac"
in_setup 'ensure_packages product test; ensure_packages product test'
expect 'what is missing is installed' $? 0 'installing missing packages: g++ cmake' 'libgtest-dev' 'what they need: 2; to fetch: 9 MB'
calls=$(wc -l <"$scratch/apt.out")
[[ $calls == 4 ]]
expect '... once' $? 0

fresh_tree
stand_in dpkg-query "$kNothingInstalled"
stand_in apt-get '
  case $* in
    *update*) echo "W: Failed to fetch http://deb.debian.org/InRelease  Temporary failure resolving" ;;
    *) echo "E: Unable to locate package cmake" >&2; exit 100 ;;
  esac'
in_setup 'ensure_packages product'
expect 'no network, and no package list' $? 10 'no network' 'http_proxy' 'Temporary failure resolving'
stand_in apt-get 'case $* in *update* | *--simulate*) echo "Inst x" ;; *--print-uris*) ;; *) echo "E: Failed to fetch http://deb.debian.org/x.deb  Could not connect"; exit 100 ;; esac'
in_setup 'ensure_packages product'
expect 'no network while fetching' $? 10 'no network'
stand_in apt-get 'case $* in *update* ) ;; *) echo "E: Unable to locate package cmake" >&2; exit 100 ;; esac'
in_setup 'ensure_packages product'
expect 'a package list without the package' $? 10 'Unable to locate package cmake' 'sources.list'
stand_in apt-get 'echo "E: Could not get lock /var/lib/dpkg/lock-frontend"; exit 100'
in_setup 'ensure_packages product'
expect 'another installation under way' $? 10 'another program is installing'
stand_in apt-get 'case $* in *--simulate*) echo "Inst x" ;; *update* | *--print-uris*) ;; *) echo "dpkg: error: No space left on device"; exit 100 ;; esac'
in_setup 'ensure_packages product'
expect 'the disk fills while unpacking' $? 10 'the disk is full'
stand_in apt-get "case \$* in *--simulate*) echo 'Inst x' ;; *--print-uris*) echo \"'http://x' x 100000000 0\" ;; esac"
stand_in df 'echo Avail; echo 400'
in_setup 'ensure_packages product'
expect 'too little disk for the packages' $? 10 'the disk is full' '400 MB are free'
stand_in df 'echo Avail; echo 50000'
in_setup 'ensure_packages product'
expect 'apt-get that does nothing' $? 10 'still missing'

DISTRIBUTION='fedora 40 Fedora Linux 40' in_setup 'ensure_packages product'
expect 'another distribution' $? 10 'wrong distribution: this is Fedora Linux 40' 'docker run'
DISTRIBUTION='debian 13 Debian GNU/Linux 13 (trixie)' in_setup 'ensure_packages product'
expect 'another Debian' $? 10 'wrong distribution: this is Debian GNU/Linux 13 (trixie)'

# An ordinary user. Only root can become one; any other user already is.
as_user=()
(( EUID != 0 )) || as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fresh_tree
stand_in dpkg-query "$kNothingInstalled"
(( EUID != 0 )) || chown -R 65534 "$scratch/tree"
PATH="$scratch/bin:$PATH" "${as_user[@]}" bash -c '
  set -euo pipefail; root=$1; . "$root/tools/setup.sh"; distribution() { echo debian 12 Debian; }
  ensure_packages product' setup "$scratch/tree" >"$scratch/result.out" 2>&1 </dev/null
expect 'packages missing, neither root nor sudo' $? 10 'may not install them' 'apt-get install --no-install-recommends g++'
if (( EUID == 0 )); then
  fresh_tree
  PATH="$scratch/bin:$PATH" "${as_user[@]}" "$scratch/tree/tools/run" >"$scratch/result.out" 2>&1 </dev/null
  expect 'a tree that belongs to another' $? 10 'no rights' 'chown'
  run
  PATH="$scratch/bin:$PATH" "${as_user[@]}" "$scratch/tree/tools/run" z >"$scratch/result.out" 2>"$scratch/error.out" </dev/null
  expect '... can be used once built' $? 3 '<z>'
fi

printf '%d passed, %d failed\n' "$passed" "$failed"
(( failed == 0 ))
