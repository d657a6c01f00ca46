# Options, compiler flags and build tools. Whatever changes the whole build (launcher, linker, build type) is touched
# only when Shoal is the top-level project; an embedding project keeps its own.

option(SHOAL_BUILD_APPS "Build the shoal tool" ${PROJECT_IS_TOP_LEVEL})
option(SHOAL_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(SHOAL_BUILD_SAMPLES "Build the samples" ${PROJECT_IS_TOP_LEVEL})
option(SHOAL_BUILD_BENCH "Build the benchmarks into the tool" ${PROJECT_IS_TOP_LEVEL})
option(SHOAL_INSTALL "Make install rules" ${PROJECT_IS_TOP_LEVEL})
option(SHOAL_WERROR "Warnings in Shoal's own code are errors" OFF)
option(SHOAL_FUZZ "Build the libFuzzer executables (clang only)" OFF)
set(SHOAL_SANITIZE "" CACHE STRING "Sanitizers for every target, as -fsanitize= takes them: address,undefined or thread")

if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
    endif()

    # The cache is shared between build folders: paths below the source tree are hashed relative to the build folder.
    find_program(SHOAL_CCACHE ccache)
    if(SHOAL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
        set(launcher env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${SHOAL_CCACHE})
        set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
        set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
    endif()

    find_program(SHOAL_LLD ld.lld)
    find_program(SHOAL_GOLD ld.gold)
    if(SHOAL_LLD)
        add_link_options(-fuse-ld=lld)
    elseif(SHOAL_GOLD)
        add_link_options(-fuse-ld=gold)
    endif()
endif()

if(SHOAL_FUZZ AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "SHOAL_FUZZ needs clang, found ${CMAKE_CXX_COMPILER_ID}; use the preset asan")
endif()

# Flags every own target gets. The floating-point flags keep results the same on every machine: nothing is reassociated
# and nothing contracted into fused operations; only errno, which nobody reads, is given up.
function(shoal_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -fno-math-errno -ffp-contract=off
        "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
        target_compile_options(${target} PRIVATE -march=x86-64-v2)
    endif()
    if(SHOAL_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(SHOAL_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${SHOAL_SANITIZE} -fno-sanitize-recover=all
            -fno-omit-frame-pointer)
        if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
            target_compile_options(${target} PRIVATE "-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitize.ignore")
        endif()
        target_link_options(${target} PUBLIC -fsanitize=${SHOAL_SANITIZE})
    endif()
    if(SHOAL_FUZZ)
        target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
endfunction()
