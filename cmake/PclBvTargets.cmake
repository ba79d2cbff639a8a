# One way to declare each kind of target, so that a folder's CMakeLists.txt says only what differs.

# What every target of the repository is compiled with. Contraction of a*b+c to FMA would give other bits on
# other instruction sets (docs/numerics.md), so it is off everywhere and never exported.
function(pcl_bv_compile_options target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  # -Wrestrict: false alarms in std::string of g++ 12 (GCC PR 105651). The SLP vectoriser of g++ 12 loses the
  # rounding of double(float(x)) where two neighbours are converted. std::stable_sort of libstdc++ 12 uses what it
  # calls deprecated itself, and clang 19 says so.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -fno-tree-slp-vectorize>
                                           $<$<CXX_COMPILER_ID:Clang>:-Wno-error=deprecated-declarations>
                                           -ffp-contract=off $<$<BOOL:${PCL_BV_WERROR}>:-Werror>)
  if(PCL_BV_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${PCL_BV_SANITIZE} -fno-sanitize-recover=all
                                             -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${PCL_BV_SANITIZE})
  endif()
endfunction()

# pcl_bv_precompile(target HEADER KIND): the first target of a kind compiles the header, the others use that: all of a
# kind have the same options.
function(pcl_bv_precompile target header kind)
  get_filename_component(path ${header} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
  get_property(owner GLOBAL PROPERTY pcl_bv_precompiled_${kind})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    set_property(GLOBAL PROPERTY pcl_bv_precompiled_${kind} ${target})
    target_precompile_headers(${target} PRIVATE ${path})
  endif()
  # What g++ 12 inlines from a precompiled std::string it takes for ours, and warns of.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow -Wno-stringop-overread
                                                                         -Wno-array-bounds>)
endfunction()

# For what asks for C's compiler too. That may be g++'s though C++'s is clang: it would rename the precompiled headers.
macro(pcl_bv_enable_c)
  set(precompiled_extension ${CMAKE_PCH_EXTENSION})
  enable_language(C)
  set(CMAKE_PCH_EXTENSION ${precompiled_extension})
endmacro()

# pcl_bv_unity(target [COUNT count]): with PCL_BV_UNITY, `count` (12) of its sources at a time are one: most of what each
# would cost is the parsing of Eigen. All at once would leave the other processors idle.
function(pcl_bv_unity target)
  cmake_parse_arguments(arg "" "COUNT" "" ${ARGN})
  if(NOT arg_COUNT)
    set(arg_COUNT 12)
  endif()
  if(PCL_BV_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${arg_COUNT})
    # g++ takes an included source for a header, where members of types in an anonymous namespace would be a mistake.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# Compiles a target as pcl_bv_library() does: targets share one precompiled header only if they have the same options.
function(pcl_bv_compile_as_library target)
  pcl_bv_compile_options(${target})
  # What public headers declare is visible (an attribute of their namespace); the rest is nobody's interface.
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE -fPIC)
  pcl_bv_precompile(${target} cmake/precompiled.h library)
  pcl_bv_unity(${target})
endfunction()

# pcl_bv_library(name [COMPONENT component] SOURCES ... PUBLIC ... PRIVATE ...): the layer `name`, as pcl_bv::name,
# installed with this component of the package (`name`). PRECOMPILED: its sources begin with cmake/precompiled.h.
# NO_UNITY: each source is compiled on its own whatever PCL_BV_UNITY says.
function(pcl_bv_library name)
  cmake_parse_arguments(arg "PRECOMPILED;NO_UNITY" "COMPONENT" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target pcl_bv_${name})
  if(arg_SOURCES)
    add_library(${target} ${arg_SOURCES})
    pcl_bv_compile_options(${target})
    # What public headers declare is visible (an attribute of their namespace); the rest is nobody's interface.
    set_target_properties(${target} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
      DEFINE_SYMBOL "" VERSION ${pcl_bv_VERSION} SOVERSION ${pcl_bv_VERSION_MAJOR}
      INSTALL_RPATH $ORIGIN) # shared ones find one another wherever the package is
    if(arg_PRECOMPILED)
      pcl_bv_precompile(${target} cmake/precompiled.h library)
    endif()
    if(NOT arg_NO_UNITY)
      pcl_bv_unity(${target})
    endif()
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(pcl_bv::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_17)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/internal) # headers for the layers above, which nobody else gets
    target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/internal>)
  endif()
  target_link_libraries(${target} ${scope} ${arg_PUBLIC})
  if(arg_PRIVATE)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE})
  endif()
  if(PCL_BV_INSTALL)
    if(NOT arg_COMPONENT)
      set(arg_COMPONENT ${name})
    endif()
    install(TARGETS ${target} EXPORT pcl_bv_${arg_COMPONENT})
    if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include) # all headers of kernels are private
      install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    endif()
  endif()
endfunction()

# pcl_bv_test(name SOURCES ... LINK ... [ISA | SETS] [SERIAL] [ALONE ...]): a GoogleTest program. With SERIAL, no test
# starts a thread, so ThreadSanitizer leaves the program out. ALONE: sources whose names mean something else in others,
# so that they are compiled on their own whatever PCL_BV_UNITY says. Labels of its tests:
#   isa       run on the instruction set that PCL_BV_ISA names; `./bootstrap test` repeats them with each of the machine
#   sets      try every set of the processor themselves: programs with SETS, and of those with ISA the tests whose name
#             says EveryInstructionSet
#   portable  no instruction set can change them
function(pcl_bv_test name)
  cmake_parse_arguments(arg "ISA;SETS;SERIAL" "" "SOURCES;LINK;ALONE" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES} ${arg_ALONE})
  # g++ would warn of new and delete that do not match where it inlines one of allocations.cpp, but not the other.
  set_source_files_properties(${arg_ALONE} ../support/allocations.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  pcl_bv_unity(${target} COUNT 4)
  if(arg_SERIAL AND PCL_BV_SANITIZE STREQUAL "thread")
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  pcl_bv_test_options(${target})
  target_link_libraries(${target} PRIVATE ${arg_LINK} pcl_bv_test_support GTest::gtest_main)
  set(discovery PRE_TEST)
  set(timeout 600)
  if(CMAKE_CROSSCOMPILING)
    set(discovery POST_BUILD) # by the emulator's own processor: those that ctest asks it to play have fewer sets
  endif()
  if(CMAKE_CROSSCOMPILING OR PCL_BV_SANITIZE)
    set(timeout 1800) # the longest tests take 16 s, 290 s in the emulator and 490 s under ThreadSanitizer
  endif()
  set(common ${target} DISCOVERY_MODE ${discovery} DISCOVERY_TIMEOUT 60)
  if(arg_ISA)
    gtest_discover_tests(${common} TEST_FILTER "-*EveryInstructionSet*" PROPERTIES LABELS isa TIMEOUT ${timeout})
    gtest_discover_tests(${common} TEST_FILTER "*EveryInstructionSet*" TEST_LIST ${target}_sets
                         PROPERTIES LABELS sets TIMEOUT ${timeout})
  else()
    gtest_discover_tests(${common} PROPERTIES LABELS $<IF:$<BOOL:${arg_SETS}>,sets,portable> TIMEOUT ${timeout})
  endif()
endfunction()

# How tests are compiled, and their support library: -O1, since most of their time is the compiler's.
function(pcl_bv_test_options target)
  pcl_bv_compile_options(${target})
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    target_compile_options(${target} PRIVATE -O1)
  endif()
  if(PCL_BV_SANITIZE) # false alarms of g++ 12 with its instrumentation
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    # The tests' own arithmetic is not what is tested: with its checks volume_tree_test.cpp takes 14.5 s to compile
    # instead of 9.2.
    target_compile_options(${target} PRIVATE -fno-sanitize=undefined)
  endif()
  target_compile_definitions(${target} PRIVATE PCL_BV_BIN_DIR="${PROJECT_BINARY_DIR}/bin"
                                               $<$<BOOL:${CMAKE_CROSSCOMPILING}>:PCL_BV_EMULATED>)
  pcl_bv_precompile(${target} tests/support/precompiled.h test)
endfunction()
