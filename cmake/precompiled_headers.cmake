# Headers of other libraries that most sources include, parsed once a target in place of once a source: a quarter of the
# time of a build. They precede every source, so a missing #include goes unnoticed: `.ci/run includes`, which tools/verify
# runs, parses all sources without them. No header of ours is among them: one change of it would compile all anew, and
# names of sources that do not include it could clash with its own.
#
# lekalo_precompile(TARGET [HEADER...]): the common headers and these.
function(lekalo_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <any> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <optional>
    <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <unordered_map> <variant> <vector>
    <fmt/format.h> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/matrix.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>
    ${ARGN})
endfunction()
