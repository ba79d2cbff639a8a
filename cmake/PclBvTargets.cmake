# One way to declare each kind of target, so that a folder's CMakeLists.txt says only what differs.

# What every target of the repository is compiled with. Contraction of a*b+c to FMA would give other bits on
# other instruction sets (docs/numerics.md), so it is off everywhere and never exported.
function(pcl_bv_compile_options target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  # -Wrestrict: false alarms in std::string of g++ 12 (GCC PR 105651). The SLP vectoriser of g++ 12 loses the
  # rounding of double(float(x)) where two neighbours are converted.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -fno-tree-slp-vectorize>
                                           -ffp-contract=off $<$<BOOL:${PCL_BV_WERROR}>:-Werror>)
  if(PCL_BV_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${PCL_BV_SANITIZE} -fno-sanitize-recover=all
                                             -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${PCL_BV_SANITIZE})
  endif()
endfunction()

# pcl_bv_library(name SOURCES ... PUBLIC ... PRIVATE ...): the layer `name`, as pcl_bv::name.
function(pcl_bv_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target pcl_bv_${name})
  if(arg_SOURCES)
    add_library(${target} ${arg_SOURCES})
    pcl_bv_compile_options(${target})
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(pcl_bv::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} ${scope} cxx_std_17)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${arg_PUBLIC})
  if(arg_PRIVATE)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE})
  endif()
  install(TARGETS ${target} EXPORT pcl_bvTargets)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# pcl_bv_program(name SOURCES ... LINK ...): a command, in build/<preset>/bin.
function(pcl_bv_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  pcl_bv_compile_options(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_link_libraries(${name} PRIVATE ${arg_LINK})
  install(TARGETS ${name})
endfunction()

# pcl_bv_test(name SOURCES ... LINK ... [ISA]): a GoogleTest program. Tests marked ISA depend on the instruction
# set: `./bootstrap test` repeats them with PCL_BV_ISA set to each one that the machine has.
function(pcl_bv_test name)
  cmake_parse_arguments(arg "ISA" "" "SOURCES;LINK" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  pcl_bv_compile_options(${target})
  if(PCL_BV_SANITIZE MATCHES thread)
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized) # false alarms of g++ 12 with its instrumentation
  endif()
  target_link_libraries(${target} PRIVATE ${arg_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE PCL_BV_BIN_DIR="${PROJECT_BINARY_DIR}/bin")
  set(discovery PRE_TEST)
  if(CMAKE_CROSSCOMPILING)
    target_compile_definitions(${target} PRIVATE PCL_BV_EMULATED)
    set(discovery POST_BUILD) # by the emulator's own processor: those that ctest asks it to play have fewer sets
  endif()
  gtest_discover_tests(${target} DISCOVERY_MODE ${discovery} DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS $<IF:$<BOOL:${arg_ISA}>,isa,portable> TIMEOUT 600)
endfunction()
