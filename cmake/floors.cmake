# One target for each folder. The order is the order of the floors: a folder links only those before it. lib, problems and solvers are
# one library for others, maxwrench::maxwrench; drawing stands apart.

# How Eigen allocates memory is part of the interface: vectors that one side allocates are freed by the other. It depends on the compiler's
# flags: without AVX Eigen takes malloc, with AVX (-march=native) blocks that it aligns itself. Whoever links the library keeps Eigen's own
# values; types.h compares them. Here they are fixed, so that AddressSanitizer changes nothing. 64 bytes serve AVX-512 and AVX.
option(MAXWRENCH_AVX "Build the library for programs that are compiled for AVX, such as with -march=native" OFF)
if(MAXWRENCH_AVX AND MAXWRENCH_WITH_PAGMO)
  message(FATAL_ERROR "MAXWRENCH_AVX needs -D MAXWRENCH_WITH_PAGMO=OFF: what libpagmo allocates without AVX would be freed with it")
endif()
if(MAXWRENCH_AVX)
  set(avx 1)
  add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64 EIGEN_MALLOC_ALREADY_ALIGNED=0)
else()
  set(avx 0)
  add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
add_compile_definitions(MAXWRENCH_AVX=${avx})

# The sources of a folder are listed in its sources.cmake. Presets join several of them to one unit, which is built in a third of the
# time: names in an unnamed namespace are unique in their folder, and the compiler says where they are not.
function(add_floor name)
  include(${PROJECT_SOURCE_DIR}/${name}/sources.cmake)
  list(TRANSFORM maxwrench_${name}_sources PREPEND ${PROJECT_SOURCE_DIR}/${name}/)
  add_library(maxwrench_${name} ${ARGN} ${maxwrench_${name}_sources})
  target_include_directories(maxwrench_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_precompile_headers(maxwrench_${name} PRIVATE <Eigen/Dense> <Eigen/Sparse> <string> <vector>)
endfunction()

# The objects also go into shared libraries and the Python module. Without -fno-semantic-interposition, calls within them would no
# longer be inlined.
function(serve_modules name)
  set_target_properties(maxwrench_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(maxwrench_${name} PRIVATE -fno-semantic-interposition)
endfunction()

# A floor of maxwrench::maxwrench; further words are what it needs.
function(add_core_floor name)
  add_floor(${name} OBJECT)
  target_include_directories(maxwrench_${name} PRIVATE ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(maxwrench_${name} PRIVATE Eigen3::Eigen ${ARGN})
  serve_modules(${name})
endfunction()

add_core_floor(lib PkgConfig::QHULL)

# It checks proofs and shares no code with what finds them: what it includes of the other folders is plain data.
add_core_floor(verify ZLIB::ZLIB PkgConfig::GMPXX)
target_compile_options(maxwrench_verify PRIVATE -ffp-contract=off)

# The way from theta_r to beta, and the collision check, stay out of joined units: in a large one GCC no longer inlines products of small
# matrices. eval_bench shows it: joined, planar/force/ellipsoid/pure/none takes 470 ns for 405, uvms/valve/linf_polytope/pure/facets 540 for 510.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/lib/robot/kinematics.cpp ${PROJECT_SOURCE_DIR}/lib/posture/posture.cpp
    ${PROJECT_SOURCE_DIR}/lib/measure/ellipsoid.cpp ${PROJECT_SOURCE_DIR}/lib/measure/wrench_program.cpp
    ${PROJECT_SOURCE_DIR}/lib/measure/polytope.cpp ${PROJECT_SOURCE_DIR}/lib/math/zonotope.cpp
    ${PROJECT_SOURCE_DIR}/problems/collision/collision.cpp ${PROJECT_SOURCE_DIR}/lib/math/gjk.cpp
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endif()

add_core_floor(problems PkgConfig::TINYXML2 PkgConfig::ASSIMP tomlplusplus::tomlplusplus fcl fmt::fmt)
file(RELATIVE_PATH from_command_to_data ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR})
target_compile_definitions(maxwrench_problems PRIVATE
  MAXWRENCH_PROBLEMS_BESIDE="${from_command_to_data}/maxwrench/problems"
  MAXWRENCH_PROBLEMS_SOURCE="${PROJECT_SOURCE_DIR}/problems"
  MAXWRENCH_PROBLEMS_INSTALLED="${CMAKE_INSTALL_FULL_DATADIR}/maxwrench/problems"
  TOML_HEADER_ONLY=0 TOML_SHARED_LIB=1)

find_package(nlohmann_json REQUIRED)
add_core_floor(solvers TBB::tbb fmt::fmt nlohmann_json::nlohmann_json PkgConfig::GMPXX)
foreach(library IPOPT CLP GLPK NLOPT PAGMO SUNDIALS)
  target_compile_definitions(maxwrench_solvers PRIVATE MAXWRENCH_WITH_${library}=$<BOOL:${MAXWRENCH_WITH_${library}}>)
  if(NOT MAXWRENCH_WITH_${library})
    continue()
  elseif(TARGET PkgConfig::${library})
    target_link_libraries(maxwrench_solvers PRIVATE PkgConfig::${library})
  else()
    target_link_libraries(maxwrench_solvers PRIVATE maxwrench::${library})
  endif()
endforeach()
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" flags)
target_compile_definitions(maxwrench_solvers PRIVATE
  "MAXWRENCH_BUILD=\"$<IF:$<CONFIG:>,no build type,$<CONFIG>>\"" "MAXWRENCH_FLAGS=\"${flags}\"")

# The version names the commit. It is looked up in every build; where it is the old one, nothing is built.
add_custom_target(maxwrench_version
  COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D RELEASE=${PROJECT_VERSION}
    -D OUTPUT=${PROJECT_BINARY_DIR}/generated/version.cpp -P ${PROJECT_SOURCE_DIR}/cmake/version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/version.cpp VERBATIM)

add_library(maxwrench_core ${PROJECT_BINARY_DIR}/generated/version.cpp
  $<TARGET_OBJECTS:maxwrench_lib> $<TARGET_OBJECTS:maxwrench_verify> $<TARGET_OBJECTS:maxwrench_problems>
  $<TARGET_OBJECTS:maxwrench_solvers>)
add_library(maxwrench::maxwrench ALIAS maxwrench_core)
add_dependencies(maxwrench_core maxwrench_version)
set_target_properties(maxwrench_core PROPERTIES OUTPUT_NAME maxwrench EXPORT_NAME maxwrench)
target_compile_features(maxwrench_core PUBLIC cxx_std_20)
target_compile_definitions(maxwrench_core INTERFACE MAXWRENCH_AVX=${avx})
target_include_directories(maxwrench_core PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
target_link_libraries(maxwrench_core PUBLIC Eigen3::Eigen PRIVATE ${maxwrench_libraries})

add_floor(drawing)
serve_modules(drawing)
add_library(maxwrench::drawing ALIAS maxwrench_drawing)
set_target_properties(maxwrench_drawing PROPERTIES EXPORT_NAME drawing)
target_link_libraries(maxwrench_drawing PUBLIC maxwrench_core PRIVATE fmt::fmt)

if(MAXWRENCH_BUILD_COMMAND OR MAXWRENCH_BUILD_BENCHMARKS)
  add_floor(benchmarks STATIC)
  target_link_libraries(maxwrench_benchmarks PUBLIC maxwrench_core PkgConfig::GMPXX PRIVATE TBB::tbb fmt::fmt ZLIB::ZLIB)
endif()

if(MAXWRENCH_BUILD_COMMAND OR MAXWRENCH_WITH_PYTHON)
  add_floor(view STATIC)
  serve_modules(view)
  target_link_libraries(maxwrench_view PUBLIC maxwrench_drawing PRIVATE nlohmann_json::nlohmann_json fmt::fmt)
  # The files that go into the program and the module.
  set(view ${PROJECT_SOURCE_DIR}/view)
  set_source_files_properties(${view}/engine/module.cpp ${view}/page_file.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_DEFINITIONS MAXWRENCH_VIEW_FOLDER="${view}" OBJECT_DEPENDS "${view}/engine/engine.js;${view}/engine/engine.wasm.gz;${view}/page/page.html")
endif()

if(MAXWRENCH_BUILD_COMMAND)
  find_package(CLI11 REQUIRED)
  add_floor(cli STATIC)
  target_link_libraries(maxwrench_cli PUBLIC maxwrench_benchmarks maxwrench_view
    PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json fmt::fmt)
  target_precompile_headers(maxwrench_cli PRIVATE <CLI/CLI.hpp> <fmt/format.h> <functional> <filesystem>)
  # It talks; half the build time is saved.
  target_compile_options(maxwrench_cli PRIVATE $<IF:$<CONFIG:Release>,-O1,-O0>)

  add_executable(maxwrench ${PROJECT_SOURCE_DIR}/cli/main.cpp)
  target_include_directories(maxwrench PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(maxwrench PRIVATE maxwrench_cli)

  # The manual page and the completion of the shell come from the command's own options.
  set(manual ${PROJECT_BINARY_DIR}/manual)
  file(MAKE_DIRECTORY ${manual})
  add_custom_command(OUTPUT ${manual}/maxwrench.1 ${manual}/maxwrench.bash
    COMMAND ${CMAKE_COMMAND} -E env --unset=MAXWRENCH_PROBLEMS $<TARGET_FILE:maxwrench> manual man > ${manual}/maxwrench.1
    COMMAND ${CMAKE_COMMAND} -E env --unset=MAXWRENCH_PROBLEMS $<TARGET_FILE:maxwrench> manual bash > ${manual}/maxwrench.bash
    DEPENDS maxwrench VERBATIM)
  add_custom_target(maxwrench_manual ALL DEPENDS ${manual}/maxwrench.1)
endif()

if(MAXWRENCH_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
  find_package(orocos_kdl REQUIRED)
  set(benches eval_bench lp_bench ode_bench trajectory_bench)
  if(MAXWRENCH_WITH_IPOPT AND MAXWRENCH_WITH_NLOPT)
    list(APPEND benches local_solve_bench)
  endif()
  foreach(bench IN LISTS benches)
    add_executable(${bench} ${PROJECT_SOURCE_DIR}/benchmarks/timing/${bench}.cpp)
    target_include_directories(${bench} PRIVATE ${PROJECT_SOURCE_DIR} ${orocos_kdl_INCLUDE_DIRS})
    target_link_libraries(${bench} PRIVATE maxwrench_benchmarks benchmark::benchmark ${orocos_kdl_LIBRARIES})
  endforeach()
endif()
