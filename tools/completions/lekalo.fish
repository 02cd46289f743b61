# fish completion for lekalo(1)

set -l commands render make compare test check measure evaluate trace export schema types
complete -c lekalo -n "not __fish_seen_subcommand_from $commands" -f
for line in 'render:render the pictures of a scene' 'make:write all outputs of a scene' \
        'compare:compare two images' 'test:run a regression suite' 'check:report all errors of a scene file' \
        'measure:lengths, areas, volumes, topology' 'evaluate:a point with derivatives and curvatures' 'trace:all hits of rays' \
        'export:write a scene for another program' 'schema:print the JSON Schema of scene files' 'types:list or describe types'
    set -l parts (string split -m 1 : $line)
    complete -c lekalo -n "not __fish_seen_subcommand_from $commands" -a $parts[1] -d $parts[2]
end
complete -c lekalo -l help -d 'show help'
complete -c lekalo -n "not __fish_seen_subcommand_from $commands" -l version -d 'show the version'

set -l picture '__fish_seen_subcommand_from render make'
complete -c lekalo -n $picture -l size -x -d 'WxH pixels'
complete -c lekalo -n $picture -l samples -x -d 'samples a pixel'
complete -c lekalo -n '__fish_seen_subcommand_from render make test' -l threads -x -d threads
complete -c lekalo -n '__fish_seen_subcommand_from render make test' -l isa -x -a 'sse2 avx2 avx512 native' -d 'instruction set'
complete -c lekalo -n $picture -l crop -x -d 'X0,Y0,X1,Y1 in pixels'
complete -c lekalo -n $picture -l layers -x -d 'layers of EXR files'
complete -c lekalo -n $picture -l half -d 'colour of EXR files as half'
complete -c lekalo -n $picture -l frames -x -d 'name=a..b:n'
complete -c lekalo -n $picture -l watch -d 'render again when a file changes'
complete -c lekalo -n $picture -l representation -x -a 'direct mesh' -d 'of every object'
complete -c lekalo -n $picture -l resume -r -d 'go on with an interrupted rendering'
complete -c lekalo -n $picture -l stats -d 'print rays, times, memory'
complete -c lekalo -n $picture -l stamp -d 'put date, machine and path into outputs'
complete -c lekalo -n '__fish_seen_subcommand_from render make export' -s o -l output -r -d 'output file'
complete -c lekalo -n '__fish_seen_subcommand_from render make check measure evaluate trace export' -l set -x -d 'name=value'
complete -c lekalo -n '__fish_seen_subcommand_from render make check measure evaluate trace export test' -l allow-external -d 'let the scene run foreign code'
complete -c lekalo -n '__fish_seen_subcommand_from compare test measure evaluate trace' -l json -d 'print JSON'
complete -c lekalo -n '__fish_seen_subcommand_from render make compare test export' -l quiet -d 'print errors only'
complete -c lekalo -n '__fish_seen_subcommand_from compare' -l metric -x -a 'flip rmse psnr ssim max' -d 'what to measure'
complete -c lekalo -n '__fish_seen_subcommand_from compare' -l threshold -x -d 'largest difference'
complete -c lekalo -n '__fish_seen_subcommand_from compare' -l layer -x -d 'layer of EXR files'
complete -c lekalo -n '__fish_seen_subcommand_from compare test' -l report -r -d 'folder of the HTML report'
complete -c lekalo -n '__fish_seen_subcommand_from test' -l filter -x -d 'tests by name'
complete -c lekalo -n '__fish_seen_subcommand_from test' -l jobs -x -d 'tests at a time'
complete -c lekalo -n '__fish_seen_subcommand_from test' -l accept -x -d 'new golden image of a test'
complete -c lekalo -n '__fish_seen_subcommand_from test' -l reason -x -d 'why it changes'
complete -c lekalo -n '__fish_seen_subcommand_from schema' -l suite -d 'of regression suites'
complete -c lekalo -n '__fish_seen_subcommand_from test' -l junit -r -d 'JUnit XML file'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l topology -d 'list vertices, edges, faces'
complete -c lekalo -n '__fish_seen_subcommand_from types' -l markdown -r -d 'write the reference into a folder'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l to -x -d 'a point (name or x,y,z), curve, surface or body'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l nearest -d 'of --to only the nearest place'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l position -x -d 'where a point lies: name, x,y,z or u,v'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l continuity -x -d 'how smoothly it joins a curve or surface'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l intersect -x -d 'a curve or surface'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l against -r -d 'table of samples, or a name'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l tolerance -x -d 'largest difference that passes'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l samples -x -d 'places in each direction'
complete -c lekalo -n '__fish_seen_subcommand_from measure' -l order -x -d 'highest derivatives compared'
complete -c lekalo -n '__fish_seen_subcommand_from evaluate' -l at -x -d 't or u,v'
complete -c lekalo -n '__fish_seen_subcommand_from evaluate' -l face -x -d 'of a body, number or name'
complete -c lekalo -n '__fish_seen_subcommand_from evaluate' -l order -x -d 'derivatives of a curve'
complete -c lekalo -n '__fish_seen_subcommand_from trace' -l ray -x -d 'ox,oy,oz,dx,dy,dz'
complete -c lekalo -n '__fish_seen_subcommand_from trace' -l rays -r -d 'file of rays'
complete -c lekalo -n '__fish_seen_subcommand_from export' -l format -x -a 'pov obj ply stl' -d 'what to write'
complete -c lekalo -n '__fish_seen_subcommand_from export' -l sag -x -d 'largest distance from the surface'
complete -c lekalo -n '__fish_seen_subcommand_from export' -l patch-steps -x -d 'steps of Bezier patches (pov)'
complete -c lekalo -n '__fish_seen_subcommand_from export' -l flatness -x -d 'flatness of Bezier patches (pov)'
