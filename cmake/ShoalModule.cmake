# shoal_add_module(NAME
#     [DIR dir]                  folder below src/, default NAME
#     [FOLDERS a b ...]          take only these subfolders of DIR
#     [EXCLUDE_FOLDERS a b ...]  take everything in DIR but these subfolders
#     [SHADERS]                  embed DIR's shaders and validate them (ShoalShaders.cmake)
#     [DEPENDS targets ...]      Shoal modules; public
#     [LIBRARIES targets ...]    outside libraries that are linked; private
#     [HEADERS targets ...])     outside header-only libraries; private and not exported
#
# Makes the static library shoal_NAME with the alias shoal::NAME. Sources are found by glob, so a new file needs no edit
# here. A module that has no source yet is an INTERFACE library that passes its dependencies on.
# Sources named *_avx2.cpp and *_avx512.cpp are compiled for x86-64-v3 and x86-64-v4; they are to be called only after
# a check of the processor at run time, and to include no header whose inline functions others use as well.
function(shoal_add_module name)
    cmake_parse_arguments(arg "SHADERS" "DIR" "FOLDERS;EXCLUDE_FOLDERS;DEPENDS;LIBRARIES;HEADERS" ${ARGN})
    if(arg_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "shoal_add_module(${name}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
    endif()
    if(NOT arg_DIR)
        set(arg_DIR ${name})
    endif()
    set(dir "${PROJECT_SOURCE_DIR}/src/${arg_DIR}")

    set(sources "")
    if(arg_FOLDERS)
        foreach(folder IN LISTS arg_FOLDERS)
            file(GLOB_RECURSE found CONFIGURE_DEPENDS "${dir}/${folder}/*.cpp")
            list(APPEND sources ${found})
        endforeach()
    else()
        file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${dir}/*.cpp")
        foreach(folder IN LISTS arg_EXCLUDE_FOLDERS)
            list(FILTER sources EXCLUDE REGEX "/src/${arg_DIR}/${folder}/")
        endforeach()
    endif()

    set(target shoal_${name})
    if(NOT sources AND NOT arg_SHADERS)
        add_library(${target} INTERFACE)
        target_compile_features(${target} INTERFACE cxx_std_20)
        set(scope INTERFACE)
    else()
        add_library(${target} STATIC ${sources})
        shoal_target_defaults(${target})
        set(scope PUBLIC)
        target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src"
            "${PROJECT_BINARY_DIR}/generated/shader_include")
        target_link_libraries(${target} PRIVATE ${arg_LIBRARIES})
        foreach(library IN LISTS arg_HEADERS)
            target_include_directories(${target} SYSTEM PRIVATE
                $<TARGET_PROPERTY:${library},INTERFACE_INCLUDE_DIRECTORIES>)
        endforeach()
        if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
            foreach(source IN LISTS sources)
                if(source MATCHES "_avx2\\.cpp$")
                    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -march=x86-64-v3)
                elseif(source MATCHES "_avx512\\.cpp$")
                    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -march=x86-64-v4)
                endif()
            endforeach()
        endif()
        if(arg_SHADERS)
            shoal_embed_shaders(${target} ${arg_DIR})
        endif()
    endif()

    add_library(shoal::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    target_include_directories(${target} ${scope}
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    foreach(module IN LISTS arg_DEPENDS)
        target_link_libraries(${target} ${scope} shoal_${module})
    endforeach()
endfunction()

# shoal_add_umbrella(NAME modules ...): one name for several modules; target shoal_NAME (plain shoal for the name shoal).
function(shoal_add_umbrella name)
    set(target shoal_${name})
    if(name STREQUAL "shoal")
        set(target shoal)
    endif()
    add_library(${target} INTERFACE)
    add_library(shoal::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    foreach(module IN LISTS ARGN)
        target_link_libraries(${target} INTERFACE shoal_${module})
    endforeach()
endfunction()
