# What several sources need is parsed once for them all; LEKALO_SHARED_PARSING=OFF parses each source alone. `.ci/run
# includes`, which tools/verify runs, does: shared, a missing #include goes unnoticed.
#
# Precompiled are headers of other libraries that most sources include. No header of ours is among them: one change of it
# would compile all anew, and names of sources that do not include it could clash with its own.
#
# lekalo_precompile(TARGET [HEADER...]): the common headers and these.
function(lekalo_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <any> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <optional>
    <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <unordered_map> <variant> <vector>
    <fmt/format.h> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/matrix.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>
    ${ARGN})
endfunction()

# lekalo_compile_together(TARGET COUNT): compiles its sources COUNT at a time, each of them in a namespace of its own.
# Only for what a change compiles anew quickly all the same, as tests.
function(lekalo_compile_together target count)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${count})
endfunction()
