# Shaders live in shaders/ folders of the modules: src/frame/shaders/shade.comp is "frame/shade.comp" to GLSL's #include,
# to C++'s #include (for *.shared.h and *.lib.glsl, which C++ compiles too) and at run time.

# shoal_embed_shaders(TARGET module): compiles the texts of src/<module>/**/shaders into TARGET as
# shoal::<module>::embeddedShaders() (src/gl/embedded_shader.h), and has glslangValidator check every entry point
# (*.vert, *.frag, *.comp, *.geom, each also with .glsl behind) with its includes resolved. A shader that fails fails the
# build.
function(shoal_embed_shaders target module)
    set(dir "${PROJECT_SOURCE_DIR}/src/${module}")
    set(tool "${PROJECT_SOURCE_DIR}/cmake/shaders.py")
    set(generated "${PROJECT_BINARY_DIR}/generated")
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS "${dir}/*.glsl" "${dir}/*.vert" "${dir}/*.frag" "${dir}/*.comp"
        "${dir}/*.geom" "${dir}/*.shared.h")
    list(FILTER shaders INCLUDE REGEX "/shaders/")

    # Lets C++ say #include "frame/x.lib.glsl" as GLSL does (shoal_add_module puts shader_include on the path).
    if(EXISTS "${dir}/shaders")
        file(MAKE_DIRECTORY "${generated}/shader_include")
        file(CREATE_LINK "${dir}/shaders" "${generated}/shader_include/${module}" SYMBOLIC)
    endif()

    set(table "${generated}/embedded/${module}_shaders.cpp")
    add_custom_command(OUTPUT "${table}"
        COMMAND Python3::Interpreter "${tool}" embed --source "${PROJECT_SOURCE_DIR}/src" --module ${module}
            --output "${table}" ${shaders}
        DEPENDS "${tool}" ${shaders} COMMENT "Embedding the shaders of ${module}" VERBATIM)
    target_sources(${target} PRIVATE "${table}")

    foreach(shader IN LISTS shaders)
        if(NOT shader MATCHES "\\.(vert|frag|comp|geom)(\\.glsl)?$")
            continue()
        endif()
        file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}/src" "${shader}")
        set(stamp "${generated}/validated/${name}.stamp")
        add_custom_command(OUTPUT "${stamp}"
            COMMAND Python3::Interpreter "${tool}" validate --source "${PROJECT_SOURCE_DIR}/src"
                --validator "${SHOAL_GLSLANG_VALIDATOR}" --stamp "${stamp}" --depfile "${stamp}.d" "${shader}"
            DEPENDS "${tool}" "${shader}" DEPFILE "${stamp}.d" COMMENT "Validating ${name}" VERBATIM)
        target_sources(${target} PRIVATE "${stamp}")
    endforeach()
endfunction()
