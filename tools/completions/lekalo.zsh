#compdef lekalo
# zsh completion for lekalo(1), written by: lekalo completions zsh

local -a commands
commands=(
  'render:Render a scene'\''s pictures (OpenEXR, PNG)'
  'make:Write everything that a scene lists under outputs'
  'merge:Put together a picture whose parts were made with render --tile'
  'farm:Print the commands that make many frames, or one picture, on many machines'
  'new:Write a commented scene to start from'
  'check:Read a scene and report all its errors'
  'solve:Tell what the constraints of a scene came to, and what they leave free'
  'evaluate:A point of a curve or surface with derivatives and curvatures'
  'compare:Compare two pictures; exit code 1 if they differ too much'
  'test:Run a regression suite of pictures and numbers'
  'measure:Length, area, volume, moments; topology; distance, intersections; comparison with a table'
  'trace:All hits of rays with the scene'\''s objects, in order'
  'draw:Draw a scene as lines (SVG, PDF, PNG, DXF, TikZ), visible and hidden ones told apart'
  'export:Write what a scene shows as triangles (OBJ, PLY, STL, glTF) and polylines (OBJ, glTF), curves and surfaces as NURBS (JSON), boundary representations (STEP), the scene for POV-Ray, a web page (HTML), or paths of cutters (CLDATA)'
  'types:List the types that scene files can name, or explain one, or a section'
  'schema:Print the JSON Schema of scene files or suites, for editors'
  'completions:Print completions for a shell, or the manual page'
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
  render)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '*-o[file to write (exr, png); repeatable]:FILE:_files' '*--output[file to write (exr, png); repeatable]:FILE:_files' \
      '--size[picture size in pixels]:WxH: ' \
      '--samples[samples per pixel]:INT: ' \
      '--threads[threads; all cores by default]:INT: ' \
      '--isa[instruction set\: sse2 gives the same bits on every machine; avx2, avx512, native \[native\]]:NAME:(sse2 avx2 avx512 native)' \
      '--crop[only this part, in pixels]:X0,Y0,X1,Y1: ' \
      '--representation[of every object\: direct or mesh]:TEXT:(direct mesh)' \
      '*--layers[layers of OpenEXR files, separated by commas; all from color to samples by default]:NAMES:(color direct indirect emission diffuse specular transmission light_groups depth position normal geometric_normal uv id albedo quantity samples variance denoised cryptomatte_object cryptomatte_material)' \
      '--half[R G B A of OpenEXR files as half (11 bits) in place of float]' \
      '--frames[N numbered pictures while a parameter runs from A to B]:NAME=A..B\:N: ' \
      '--only[of --frames only these, by number]:9-16,20: ' \
      '--skip-existing[leave out pictures that are there already, and go on with those that were begun]' \
      '--tile[part I of N of the picture, kept for '\''lekalo merge'\'']:I/N: ' \
      '--progress[progress as lines for other programs]' \
      '--shutter[motion blur\: the mean of N pictures while a parameter runs from A to B, the samples shared among them]:NAME=A..B\:N: ' \
      '--watch[again when the scene or a file that it reads changes, until Ctrl-C]' \
      '--resume[go on from a .partial file; without FILE from that of the picture, if there is one]:FILE:_files' \
      '--stamp[put date, machine and the scene'\''s path into the pictures]' \
      '--quiet[no progress, no notes]' \
      '--stats[print times, counts and memory]' ;;
  make)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '*-o[file to write (exr, png); repeatable]:FILE:_files' '*--output[file to write (exr, png); repeatable]:FILE:_files' \
      '--size[picture size in pixels]:WxH: ' \
      '--samples[samples per pixel]:INT: ' \
      '--threads[threads; all cores by default]:INT: ' \
      '--isa[instruction set\: sse2 gives the same bits on every machine; avx2, avx512, native \[native\]]:NAME:(sse2 avx2 avx512 native)' \
      '--crop[only this part, in pixels]:X0,Y0,X1,Y1: ' \
      '--representation[of every object\: direct or mesh]:TEXT:(direct mesh)' \
      '*--layers[layers of OpenEXR files, separated by commas; all from color to samples by default]:NAMES:(color direct indirect emission diffuse specular transmission light_groups depth position normal geometric_normal uv id albedo quantity samples variance denoised cryptomatte_object cryptomatte_material)' \
      '--half[R G B A of OpenEXR files as half (11 bits) in place of float]' \
      '--frames[N numbered pictures while a parameter runs from A to B]:NAME=A..B\:N: ' \
      '--only[of --frames only these, by number]:9-16,20: ' \
      '--skip-existing[leave out pictures that are there already, and go on with those that were begun]' \
      '--tile[part I of N of the picture, kept for '\''lekalo merge'\'']:I/N: ' \
      '--progress[progress as lines for other programs]' \
      '--shutter[motion blur\: the mean of N pictures while a parameter runs from A to B, the samples shared among them]:NAME=A..B\:N: ' \
      '--watch[again when the scene or a file that it reads changes, until Ctrl-C]' \
      '--resume[go on from a .partial file; without FILE from that of the picture, if there is one]:FILE:_files' \
      '--stamp[put date, machine and the scene'\''s path into the pictures]' \
      '--quiet[no progress, no notes]' \
      '--stats[print times, counts and memory]' \
      '--list[a command on each line\: those whose files are missing, side by side]:FILE:_files' ;;
  merge)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      '*:FILE...:_files' \
      '-o[file to write (exr, png); repeatable]:FILE:_files' '--output[file to write (exr, png); repeatable]:FILE:_files' \
      '--scene[the scene, where it lies elsewhere than when the parts were made]:FILE:_files' \
      '--quiet[no progress, no notes]' ;;
  farm)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':NAME:(slurm list)' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '*-o[file to write (exr, png); repeatable]:FILE:_files' '*--output[file to write (exr, png); repeatable]:FILE:_files' \
      '--size[picture size in pixels]:WxH: ' \
      '--samples[samples per pixel]:INT: ' \
      '--threads[of each task; all cores by default]:INT: ' \
      '--frames[N numbered pictures while a parameter runs from A to B]:NAME=A..B\:N: ' \
      '--tiles[N parts of one picture]:N: ' \
      '--merge[with list\: the command that puts the parts together]' ;;
  new)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':NAME: ' \
      '--kind[what it makes]:KIND:(picture drawing graph plate suite)' ;;
  check)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '--json[print the errors and warnings as JSON, for editors and scripts]' ;;
  solve)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '--json[machine-readable output]' \
      '--graph[how the system is taken apart\: blocks, rigid parts]' ;;
  evaluate)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      ':TEXT: ' \
      '--at[parameter t, or u,v; formulas without names]:T|U,V: ' \
      '--uv[of surfaces over triangles, one or many\: the parameters of the triangles in place of the squares'\'']:U,V: ' \
      '--table[at each row of a table\: t, or u and v]:FILE:_files' \
      '--divided-difference[of a curve its divided differences over these nodes instead]:T,T,..: ' \
      '--face[face of a body or patch of a set, as trace and measure --topology call it]:NUMBER|NAME: ' \
      '*--along[of a surface its normal curvature in this direction of its parameters; of two the angle between]:DU,DV: ' \
      '--tilt[of a surface the axis of a milling tool that runs in the first of these directions, at this angle to the tangent plane]:DEGREES: ' \
      '--turn[the step of the parameter over which the tangent, or along u and v the normal, turns by this angle]:DEGREES: ' \
      '--metric[of a surface also Christoffel'\''s symbols and the curvature tensors of its metric]' \
      '--order[derivatives of a curve up to this order]:INT: ' \
      '--placement[the matrix that places things at the point\: columns tangent, normal, binormal and the point]' \
      '*--on[the same with the normal of a surface that the curve lies on, or between those of two]:NAME: ' \
      '--share[of the first of two surfaces in the direction of the normal \[0.5\]]:FLOAT: ' \
      '--json[print JSON]' ;;
  compare)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':A:_files' \
      ':B:_files' \
      '--metric[flip, rmse, psnr, ssim or max \[flip\]]:NAME:(flip rmse psnr ssim max)' \
      '--threshold[worst value that passes \[without\: only equal pictures\]]:X: ' \
      '--layer[color, normal, geometric_normal, depth, position, uv, albedo or an OpenEXR layer \[color\]]:NAME: ' \
      '--report[write a page with both pictures and the error map]:DIR:_files -/' \
      '--json[print the figures as JSON]' \
      '--quiet[print nothing]' ;;
  test)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--filter[only tests whose name matches, * stands for anything; repeatable]:PATTERN: ' \
      '--jobs[tests at a time \[1\]]:INT: ' \
      '--threads[threads; all cores by default]:INT: ' \
      '--isa[instruction set\: sse2 gives the same bits on every machine; avx2, avx512, native \[native\]]:NAME:(sse2 avx2 avx512 native)' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '--report[write a page with all pictures and figures]:DIR:_files -/' \
      '--junit[write the results as JUnit XML]:FILE:_files' \
      '*--accept[make the last run'\''s picture of this test golden; repeatable]:NAME: ' \
      '--reason[why; kept in golden/NAME.txt]:TEXT: ' \
      '--json[print the results as JSON]' \
      '--quiet[print failures only]' ;;
  measure)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      ':TEXT: ' \
      '--topology[faces, edges and vertices with their names instead]' \
      '--regularity[whether the curve or surface is regular\: bounds of speed and curvature]' \
      '--cubature[area and volume by rules of so many points on triangular cells, without bounds of the error\: 1, 3, 4, 6 or 7, exact for degrees 1 to 5]:POINTS:(1 3 4 6 7)' \
      '--cells[cut into so many cells\: bounds of their diameters and of the surface'\''s]:NU,NV: ' \
      '--to[distance from a point, with all its feet; from a curve, surface or body, with all minima]:NAME|X,Y,Z: ' \
      '*--intersect[where the curve, surface or body meets another\: crossings, contacts, common parts, curves; given twice, the common points of three surfaces or bodies]:NAME: ' \
      '--self-intersection[where the curve or surface meets itself\: crossings, contacts, cusps, parts run twice, curves]' \
      '--section[where a plane cuts the surface or body\: a point of the plane and its normal]:X,Y,Z,NX,NY,NZ: ' \
      '--silhouette[the outline of the surface or body as the scene'\''s camera sees it, along a direction, or from an eye]:camera|DX,DY,DZ|eye\:X,Y,Z: ' \
      '--position[where a point lies\: above or below a surface, inside or outside of a body or closed plane curve; or U,V in the region of a trimmed surface]:NAME|X,Y,Z|U,V: ' \
      '--continuity[how smoothly it joins another curve or surface; alone, how a body'\''s faces or the pieces of a curve join\: G0 to G3]:\[NAME\]: ' \
      '--nurbs[the curve or surface as NURBS\: degree, knots, points, weights, Bezier pieces; exact, else fitted]' \
      '--features[inflections, vertices, cusps and corners of the curve, total curvature, the widest angle between tangents (monotone\: less than a right one); of a closed plane one its turning number and area; of a surface its umbilics]' \
      '--arc[the length of the curve'\''s part between two parameters]:T,T: ' \
      '--at-length[the parameter at this length from the curve'\''s beginning]:LENGTH: ' \
      '--hausdorff[how far the farthest point of the curve or of another one is from the other\: a certain bracket]:NAME: ' \
      '--frechet[the same for points that run along both curves at best, from beginning to end]:NAME: ' \
      '--against[table of points with columns t,x,y,z or u,v,x,y,z; or another curve or surface of the scene, whose domain is mapped linearly]:FILE|NAME:_files' \
      '--rim[whether the closed plane curve is the rim of a sheet that may overlap itself]' \
      '--stretch[by how much the surface stretches when it is laid on another one of the same parameters, as a development on its surface]:NAME: ' \
      '--blank[the smallest box that stands along this direction and holds the curve, surface or body, and by how much it is turned about it\: the blank of a workpiece]:DX,DY,DZ: ' \
      '--turn[of --cubature, how far the normal turns inside of a cell at most \[20\]]:DEGREES: ' \
      '--line[of --cells, a point and a direction\: whether the diameters prove that the line misses the surface]:X,Y,Z,DX,DY,DZ: ' \
      '--nearest[of --to only what is nearest, which takes less time]' \
      '--chord[of --rim, two parameters\: whether the straight line between the points is one line on the sheet]:T,T: ' \
      '--secant[the same of a curve between these points, as that of the section by a cylinder]:NAME: ' \
      '--tolerance[largest difference that passes; of --intersect and --self-intersection the part of the size below which points are one \[1e-09\]; of --continuity the relative jump that passes \[1e-06\]]:X: ' \
      '--samples[of --against and --stretch, places in each direction \[65\]; of curves that surfaces make, points along each branch]:N: ' \
      '--order[compare derivatives up to this order \[2\]]:N: ' \
      '--json[print JSON]' ;;
  trace)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '--ray[origin and direction; formulas without names]:OX,OY,OZ,DX,DY,DZ: ' \
      '--rays[a table of rays, one a row\: ox, oy, oz, dx, dy, dz]:FILE:_files' \
      '--json[print JSON]' ;;
  draw)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '*-o[file to write (svg, pdf, png, dxf, tikz; tex with --standalone) in place of the scene'\''s outputs; repeatable]:FILE:_files' '*--output[file to write (svg, pdf, png, dxf, tikz; tex with --standalone) in place of the scene'\''s outputs; repeatable]:FILE:_files' \
      '--size[pixels of the page, which keeps its width\: of png files, of the ground]:WxH: ' \
      '--width[millimetres of the drawing; texts and lines keep their size]:MM: ' \
      '--crop[only this part of the page, in pixels]:X0,Y0,X1,Y1: ' \
      '--threads[threads; all cores by default]:INT: ' \
      '--isa[instruction set\: sse2 gives the same bits on every machine; avx2, avx512, native \[native\]]:NAME:(sse2 avx2 avx512 native)' \
      '--latex[texts in FILE.tex, for LaTeX to set over the drawing (pdf, png)]' \
      '--standalone[tikz and tex files as documents of their own]' \
      '--outlines[texts of svg files as outlines in place of text and fonts]' \
      '--quiet[no progress and no notes]' \
      '--stats[print how many lines and pieces there are, and times]' ;;
  export)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':scene:_files -g "*.(yaml|yml|json)"' \
      '*--set[value of a parameter, e.g. --set w=4; repeatable]:NAME=VALUE: ' \
      '--allow-external[let the scene run code from outside the program\: libraries and commands that it names]' \
      '*:NAME: ' \
      '--format[what to write; else the output'\''s extension decides]:NAME:(obj ply stl gltf glb html json step pov cldata)' \
      '-o[file to write; without it SCENE.FORMAT here]:FILE:_files' '--output[file to write; without it SCENE.FORMAT here]:FILE:_files' \
      '--sag[largest distance of a triangle from its surface, of a chord from its curve]:LENGTH: ' \
      '--tolerance[step\: largest distance of a fit, of the size of each]:NUMBER: ' \
      '--flatness[pov\: flatness of Bezier patches, in scene units]:LENGTH: ' \
      '--patch-steps[pov\: u_steps and v_steps of Bezier patches]:INT: ' \
      '--quiet[print no summary]' ;;
  types)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':TEXT: ' \
      '--markdown[write the reference manual into this folder]:DIR:_files -/' ;;
  schema)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      '--suite[of regression suites]' ;;
  completions)
    _arguments \
      '-h[Print this help message and exit]' '--help[Print this help message and exit]' \
      ':KIND:(bash zsh fish man)' ;;
esac
