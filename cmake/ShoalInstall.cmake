# Two export sets, so that find_package(shoal COMPONENTS cpu) asks for no GL package at all.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/shoal")
set(techniques water crowd fluid volume)

set(cpu_targets shoal_core shoal_light shoal_io shoal_cpu)
set(gl_targets shoal_gl shoal_frame shoal_scene shoal_pipeline shoal)
foreach(technique IN LISTS techniques)
    list(APPEND cpu_targets shoal_${technique}_cpu)
    list(APPEND gl_targets shoal_${technique})
endforeach()

install(TARGETS ${cpu_targets} EXPORT shoalCpuTargets ARCHIVE COMPONENT library)
install(TARGETS ${gl_targets} EXPORT shoalGlTargets ARCHIVE COMPONENT library)
install(EXPORT shoalCpuTargets NAMESPACE shoal:: DESTINATION "${package_dir}" COMPONENT library)
install(EXPORT shoalGlTargets NAMESPACE shoal:: DESTINATION "${package_dir}" COMPONENT library)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/shoal" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT library)

write_basic_package_version_file("${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/shoalConfig.cmake" "${PROJECT_SOURCE_DIR}/cmake/Findepoxy.cmake"
    "${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake" DESTINATION "${package_dir}" COMPONENT library)

if(TARGET shoal_tool)
    install(TARGETS shoal_tool RUNTIME COMPONENT tool)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes" DESTINATION "${CMAKE_INSTALL_DATADIR}/shoal" COMPONENT tool OPTIONAL)
# What `shoal bench` measures errors on.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/tests/scenes/" DESTINATION "${CMAKE_INSTALL_DATADIR}/shoal/checks" COMPONENT tool OPTIONAL)
# The viewer's letters, for machines that have no fonts of their own.
foreach(font IN ITEMS DejaVuSans.ttf DejaVuSansMono.ttf)
    install(FILES "/usr/share/fonts/truetype/dejavu/${font}" DESTINATION "${CMAKE_INSTALL_DATADIR}/shoal/fonts"
        COMPONENT tool OPTIONAL)
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT tool)
