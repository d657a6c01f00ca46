# find_package(shoal [COMPONENTS cpu gl])
#   cpu  shoal::cpu, and each of shoal::core light io water_cpu crowd_cpu fluid_cpu volume_cpu: no GL needed
#   gl   shoal::shoal, and each of shoal::gl frame water crowd fluid volume scene pipeline; includes cpu
# Without components both are found. The dependencies are the shared libraries that Shoal's static libraries need.
include(CMakeFindDependencyMacro)

if(NOT shoal_FIND_COMPONENTS)
    set(shoal_FIND_COMPONENTS cpu gl)
endif()
foreach(component IN LISTS shoal_FIND_COMPONENTS)
    if(component MATCHES "^(cpu|gl)$")
        set(shoal_${component}_FOUND TRUE)
    elseif(shoal_FIND_REQUIRED_${component})
        set(shoal_FOUND FALSE)
        set(shoal_NOT_FOUND_MESSAGE "shoal has no component ${component}; it has cpu and gl")
        return()
    endif()
endforeach()

find_dependency(TBB)
find_dependency(fmt)
find_dependency(assimp)
find_dependency(OpenEXR 3.1)
find_dependency(ZLIB)
include("${CMAKE_CURRENT_LIST_DIR}/shoalCpuTargets.cmake")

if(shoal_gl_FOUND)
    list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
    find_dependency(epoxy)
    find_dependency(glfw3 3.3)
    list(REMOVE_ITEM CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
    include("${CMAKE_CURRENT_LIST_DIR}/shoalGlTargets.cmake")
endif()
