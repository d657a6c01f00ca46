# Everything from outside. All of it is private to the modules: no public header shows any of it.
# What is linked must be found again by whoever links the installed static libraries; shoalConfig.cmake lists it.
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
find_program(SHOAL_GLSLANG_VALIDATOR glslangValidator REQUIRED)

find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(assimp REQUIRED)
find_package(kissfft CONFIG REQUIRED COMPONENTS SHARED)
find_package(nlohmann_json REQUIRED)
find_package(embree 3 REQUIRED)
find_package(epoxy REQUIRED)
find_package(glfw3 3.3 REQUIRED)

# Taken as headers, compiled in one source file: the packaged shared library fixes options we set ourselves (exceptions)
# and would have to travel with the bundle.
find_path(SHOAL_TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
add_library(shoal_tomlplusplus INTERFACE IMPORTED)
target_include_directories(shoal_tomlplusplus INTERFACE "${SHOAL_TOMLPLUSPLUS_INCLUDE_DIR}")

# The viewer's alone. Debian's archive holds every backend; the linker takes the one that is used.
find_path(SHOAL_IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(SHOAL_IMGUI_LIBRARY NAMES libimgui.a imgui)
find_library(SHOAL_STB_LIBRARY NAMES libstb.a stb)
if(SHOAL_IMGUI_INCLUDE_DIR AND SHOAL_IMGUI_LIBRARY)
    add_library(shoal_imgui INTERFACE IMPORTED)
    target_include_directories(shoal_imgui SYSTEM INTERFACE "${SHOAL_IMGUI_INCLUDE_DIR}")
    target_link_libraries(shoal_imgui INTERFACE "${SHOAL_IMGUI_LIBRARY}" ${CMAKE_DL_LIBS})
    if(SHOAL_STB_LIBRARY)
        target_link_libraries(shoal_imgui INTERFACE "${SHOAL_STB_LIBRARY}")
    endif()
elseif(SHOAL_BUILD_APPS OR SHOAL_BUILD_BENCH)
    message(FATAL_ERROR "Dear ImGui not found, expected Debian's libimgui-dev (scripts/setup build)")
endif()
