# bash completion for lekalo(1)

_lekalo() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=''
  COMPREPLY=()

  case $previous in
    --representation) words='direct mesh' ;;
    --kind) words='picture drawing graph plate suite' ;;
    --metric) words='flip rmse psnr ssim max' ;;
    --isa) words='sse2 avx2 avx512 native' ;;
    --layers) words='color direct depth position normal geometric_normal uv id albedo samples' ;;
    --format) words='pov obj ply stl json step' ;;
    --size | --samples | --threads | --crop | --set | --frames | --threshold | --layer | --at | --uv | --face | --order | --sag | --patch-steps | --flatness | --tolerance | --cells | --line | --on | --share | --divided-difference | --along | --ray | --filter | --jobs | --accept | --reason)
      return ;;
    -o | --output | --against | --rays | --junit | --resume) compopt -o default; return ;;
    --report) compopt -o dirnames; return ;;
  esac
  if [[ -z $words ]]; then
    if (( COMP_CWORD == 1 )); then
      words='render make draw compare test new check solve measure evaluate trace export schema types --help --version'
    elif [[ $current == -* ]]; then
      case $command in
        render | make) words='-o --output --size --samples --threads --isa --crop --half --layers --representation --set --allow-external --frames --watch --resume --quiet --stats --stamp' ;;
        draw) words='-o --output --set --allow-external --latex --standalone --outlines --quiet --stats' ;;
        compare) words='--metric --threshold --layer --report --json --quiet' ;;
        test) words='--filter --jobs --threads --isa --allow-external --accept --reason --report --junit --json --quiet' ;;
        new) words='--kind' ;;
        check|solve) words='--set --allow-external --json' ;;
        measure) words='--topology --to --nearest --frechet --hausdorff --at-length --arc --features --nurbs --cubature --turn --rim --chord --secant --stretch --regularity --cells --line --position --continuity --intersect --self-intersection --section --silhouette --against --tolerance --samples --order --set --allow-external --json' ;;
        evaluate) words='--at --uv --turn --table --along --face --on --share --placement --divided-difference --order --set --allow-external --json' ;;
        trace) words='--ray --rays --set --allow-external --json' ;;
        export) words='--format --sag --patch-steps --flatness --tolerance -o --output --set --allow-external --quiet' ;;
        types) words='--markdown' ;;
        schema) words='--suite' ;;
      esac
      words+=' --help'
    fi
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else
    local file pattern='\.(yaml|yml|json)$'
    [[ $command != compare ]] || pattern='\.(exr|png)$'
    while read -r file; do
      [[ ! -d $file && ! $file =~ $pattern ]] || COMPREPLY+=("$file")
    done < <(compgen -f -- "$current")
    compopt -o filenames
  fi
}
complete -F _lekalo lekalo
