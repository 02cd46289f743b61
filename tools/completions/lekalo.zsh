#compdef lekalo
# zsh completion for lekalo(1)

local -a commands scene picture
commands=(
  'render:render the pictures of a scene'
  'make:write all outputs of a scene'
  'draw:draw a scene as lines'
  'compare:compare two images'
  'test:run a regression suite'
  'new:write a commented scene to start from'
  'check:report all errors of a scene file'
  'solve:tell what the constraints of a scene came to'
  'measure:lengths, areas, volumes, topology'
  'evaluate:a point with derivatives and curvatures'
  'trace:all hits of rays'
  'export:write a scene for another program'
  'schema:print the JSON Schema of scene files'
  'types:list or describe the types of scene files'
)
scene=('*--set[set a parameter]:name=value' '--allow-external[let the scene run foreign code]' '--help[show help]')
picture=(
  '*'{-o,--output}'[output file]:file:_files' '--representation[of every object]:kind:(direct mesh)'
  '--size[pixels]:WxH' '--samples[samples a pixel]:number' '--threads[threads]:number' '--isa[instruction set]:name:(sse2 avx2 avx512 native)'
  '--crop[window in pixels]:X0,Y0,X1,Y1' '--layers[layers of EXR files]:names' '--half[colour of EXR files as half]' '--frames[sequence over a parameter]:name=a..b\:n'
  '--watch[render again when a file changes]' '--resume[go on with an interrupted rendering]:file:_files -g "*.partial"'
  '--quiet[print errors only]' '--stats[print rays, times, memory]' '--stamp[put date, machine and path into outputs]'
)

if (( CURRENT == 2 )); then
  _describe command commands
  _arguments '--help[show help]' '--version[show the version]'
  return
fi

local command=$words[2]
shift words
(( CURRENT-- ))
case $command in
  render | make) _arguments $scene $picture '*:scene:_files -g "*.(yaml|yml|json)"' ;;
  draw) _arguments $scene '*'{-o,--output}'[output file]:file:_files' '--latex[texts in a file for LaTeX]' '--standalone[TikZ pictures as documents]' '--outlines[texts of svg files as outlines]' '--quiet[print errors only]' '--stats[print lines, pieces, times]' '*:scene:_files -g "*.(yaml|yml|json)"' ;;
  compare) _arguments '--metric[what to measure]:metric:(flip rmse psnr ssim max)' '--threshold[largest difference]:number' \
    '--layer[layer of EXR files]:name' '--report[HTML report]:folder:_files -/' '--json[print JSON]' '--quiet[print errors only]' \
    '--help[show help]' '*:image:_files -g "*.(exr|png)"' ;;
  test) _arguments '--allow-external[let scenes run foreign code]' '--filter[tests by name]:pattern' '--jobs[tests at a time]:number' '--threads[threads]:number' '--isa[instruction set]:name:(sse2 avx2 avx512 native)' '--accept[new golden image]:name' \
    '--reason[why it changes]:text' '--report[HTML report]:folder:_files -/' '--junit[JUnit XML]:file:_files' '--json[print JSON]' \
    '--quiet[print errors only]' '--help[show help]' '*:suite:_files -g "*.(yaml|yml|json)"' ;;
  new) _arguments '--kind[what it makes]:kind:(picture drawing graph plate suite)' '--help[show help]' '1:name' ;;
  check|solve) _arguments $scene '--json[print JSON]' '*:scene:_files -g "*.(yaml|yml|json)"' ;;
  measure) _arguments $scene '--topology[list vertices, edges, faces]' '--to[a point, curve, surface or body]:name or x,y,z' '--nearest[only the nearest place]' '--frechet[Frechet distance from a curve]:name' '--hausdorff[Hausdorff distance from a curve]:name' '--at-length[parameter at a length]:length' '--arc[length between two parameters]:t t' '--features[inflections, vertices, cusps, total curvature, area]' '--nurbs[the curve or surface as NURBS]' '--cubature[by a rule on triangles]:points' '--turn[of --cubature, angle over a cell]:degrees' '--rim[whether it is the rim of a sheet]' '--chord[of --rim, two parameters]:t t' '--secant[with --chord, a curve between the points]:name' '--stretch[how much it stretches on another surface]:name' '--regularity[whether it is regular, with bounds]' '--cells[bounds of the diameters of cells]:nu,nv' '--line[of --cells, a line]:x,y,z,dx,dy,dz' '--position[a point]:name, x,y,z or u,v' '--continuity[how smoothly it joins]:name' '*--intersect[a curve, surface or body]:name' '--self-intersection[where it meets itself]' '--section[a plane]:x,y,z,nx,ny,nz' '--silhouette[a view]:camera, dx,dy,dz or eye\:x,y,z' '--against[table of samples, or a name]:file:_files' '--tolerance[largest difference that passes]:number' '--samples[places in each direction]:number' '--order[highest derivatives compared]:number' '--json[print JSON]' \
    '1:scene:_files -g "*.(yaml|yml|json)"' '*:name' ;;
  evaluate) _arguments $scene '--at[where]:t or u,v' '--uv[parameters of a triangle]:u,v' '--turn[step over which it turns by an angle]:degrees' '--face[of a body]:number or name' '*--along[direction in the parameters of a surface]:du,dv' '--table[table of parameters]:file:_files' '*--on[with the normal of a surface]:name' '--share[of two surfaces, that of the first]:number' '--placement[the matrix that places things there]' '--divided-difference[nodes of divided differences]:t t ..' '--order[derivatives]:number' '--json[print JSON]' '1:scene:_files -g "*.(yaml|yml|json)"' '*:name' ;;
  trace) _arguments $scene '--ray[origin and direction]:ox,oy,oz,dx,dy,dz' '--rays[file of rays]:file:_files' '--json[print JSON]' \
    '*:scene:_files -g "*.(yaml|yml|json)"' ;;
  export) _arguments $scene '--format[what to write]:format:(pov obj ply stl json step)' '--sag[largest distance from the surface]:length' '--patch-steps[steps of Bezier patches (pov)]:number' '--flatness[flatness of Bezier patches (pov)]:length' '--tolerance[largest distance of a fit, of its size (step)]:number' '*'{-o,--output}'[output file]:file:_files' '--quiet[print errors only]' \
    '*:scene:_files -g "*.(yaml|yml|json)"' ;;
  schema) _arguments '--suite[of regression suites]' '--help[show help]' ;;
  types) _arguments '--markdown[write the reference into a folder]:folder:_files -/' '--help[show help]' '1:type' ;;
esac
