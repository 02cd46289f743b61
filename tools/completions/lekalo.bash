# bash completion for lekalo(1), written by: lekalo completions bash

_lekalo() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=''
  COMPREPLY=()

  case $command:$previous in
    render:-o | render:--output | render:--resume | make:-o | make:--output | make:--resume | make:--list | merge:-o | merge:--output | merge:--scene | farm:-o | farm:--output | evaluate:--table | test:--junit | trace:--rays | draw:-o | draw:--output | export:-o | export:--output)
      compopt -o default; return ;;
    compare:--report | test:--report | types:--markdown)
      compopt -o dirnames; return ;;
    render:--set | render:--size | render:--samples | render:--threads | render:--crop | render:--frames | render:--only | render:--tile | render:--shutter | make:--set | make:--size | make:--samples | make:--threads | make:--crop | make:--frames | make:--only | make:--tile | make:--shutter | farm:--set | farm:--size | farm:--samples | farm:--threads | farm:--frames | farm:--tiles | check:--set | solve:--set | evaluate:--set | evaluate:--at | evaluate:--uv | evaluate:--divided-difference | evaluate:--face | evaluate:--along | evaluate:--tilt | evaluate:--turn | evaluate:--order | evaluate:--on | evaluate:--share | compare:--threshold | compare:--layer | test:--filter | test:--jobs | test:--threads | test:--accept | test:--reason | measure:--set | measure:--cells | measure:--to | measure:--intersect | measure:--section | measure:--silhouette | measure:--position | measure:--continuity | measure:--arc | measure:--at-length | measure:--hausdorff | measure:--frechet | measure:--against | measure:--stretch | measure:--blank | measure:--turn | measure:--line | measure:--chord | measure:--secant | measure:--tolerance | measure:--samples | measure:--order | trace:--set | trace:--ray | draw:--set | draw:--size | draw:--width | draw:--crop | draw:--threads | export:--set | export:--sag | export:--tolerance | export:--flatness | export:--patch-steps)
      return ;;
    measure:--cubature)
      words='1 3 4 6 7' ;;
    render:--layers | make:--layers)
      words='color direct indirect emission diffuse specular transmission light_groups depth position normal geometric_normal uv id albedo quantity samples variance denoised cryptomatte_object cryptomatte_material' ;;
    render:--representation | make:--representation)
      words='direct mesh' ;;
    compare:--metric)
      words='flip rmse psnr ssim max' ;;
    export:--format)
      words='obj ply stl gltf glb html json step pov cldata' ;;
    new:--kind)
      words='picture drawing graph plate suite' ;;
    render:--isa | make:--isa | test:--isa | draw:--isa)
      words='sse2 avx2 avx512 native' ;;
  esac
  if [[ -z $words ]]; then
    if (( COMP_CWORD == 1 )); then
      words='render make merge farm new check solve evaluate compare test measure trace draw export types schema completions --help --version'
    elif [[ $current == -* ]]; then
      case $command in
        render) words='-h --help --set --allow-external -o --output --size --samples --threads --isa --crop --representation --layers --half --frames --only --skip-existing --tile --progress --shutter --watch --resume --stamp --quiet --stats' ;;
        make) words='-h --help --set --allow-external -o --output --size --samples --threads --isa --crop --representation --layers --half --frames --only --skip-existing --tile --progress --shutter --watch --resume --stamp --quiet --stats --list' ;;
        merge) words='-h --help -o --output --scene --quiet' ;;
        farm) words='-h --help --set --allow-external -o --output --size --samples --threads --frames --tiles --merge' ;;
        new) words='-h --help --kind' ;;
        check) words='-h --help --set --allow-external --json' ;;
        solve) words='-h --help --set --allow-external --json --graph' ;;
        evaluate) words='-h --help --set --allow-external --at --uv --table --divided-difference --face --along --tilt --turn --metric --order --placement --on --share --json' ;;
        compare) words='-h --help --metric --threshold --layer --report --json --quiet' ;;
        test) words='-h --help --filter --jobs --threads --isa --allow-external --report --junit --accept --reason --json --quiet' ;;
        measure) words='-h --help --set --allow-external --topology --regularity --cubature --cells --to --intersect --self-intersection --section --silhouette --position --continuity --nurbs --features --arc --at-length --hausdorff --frechet --against --rim --stretch --blank --turn --line --nearest --chord --secant --tolerance --samples --order --json' ;;
        trace) words='-h --help --set --allow-external --ray --rays --json' ;;
        draw) words='-h --help --set --allow-external -o --output --size --width --crop --threads --isa --latex --standalone --outlines --quiet --stats' ;;
        export) words='-h --help --set --allow-external --format -o --output --sag --tolerance --flatness --patch-steps --quiet' ;;
        types) words='-h --help --markdown' ;;
        schema) words='-h --help --suite' ;;
        completions) words='-h --help' ;;
      esac
    elif (( COMP_CWORD == 2 )); then
      case $command in
        farm) words='slurm list' ;;
        completions) words='bash zsh fish man' ;;
      esac
    fi
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else
    local file pattern=''
    case $command in
      render | make | farm | check | solve | evaluate | test | measure | trace | draw | export) pattern='\.(yaml|yml|json)$' ;;
    esac
    while read -r file; do
      [[ ! -d $file && ! $file =~ $pattern ]] || COMPREPLY+=("$file")
    done < <(compgen -f -- "$current")
    compopt -o filenames
  fi
}
complete -F _lekalo lekalo
