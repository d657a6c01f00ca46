# Everything from outside. All of it is private to the modules: no public header shows any of it.
# What is linked must be found again by whoever links the installed static libraries; shoalConfig.cmake.in lists it.
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
find_program(SHOAL_GLSLANG_VALIDATOR glslangValidator REQUIRED)

find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(assimp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(epoxy REQUIRED)
find_package(glfw3 3.3 REQUIRED)

# Taken as headers, each compiled in one source file: the packaged shared libraries fix options we set ourselves
# (tinygltf's image loading, toml++'s exceptions) and would have to travel with the bundle.
function(shoal_find_headers target header)
    find_path(${target}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
    add_library(${target} INTERFACE IMPORTED)
    target_include_directories(${target} INTERFACE "${${target}_INCLUDE_DIR}")
endfunction()
shoal_find_headers(shoal_tinygltf tiny_gltf.h)
shoal_find_headers(shoal_stb stb_image.h stb)
shoal_find_headers(shoal_tomlplusplus toml++/toml.h)
