# Run as a script at build time: writes SHOAL_VERSION and SHOAL_COMMIT to OUTPUT.
set(commit "unknown")
find_package(Git QUIET)
if(GIT_FOUND)
    execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE}" rev-parse --short=12 HEAD
        OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
        set(commit "${found}")
        execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE}" diff --quiet HEAD -- RESULT_VARIABLE changed
            ERROR_QUIET)
        if(changed)
            string(APPEND commit "+")
        endif()
    endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#pragma once
#define SHOAL_VERSION "@VERSION@"
#define SHOAL_COMMIT "@commit@"  // a + behind it: the tree had changes
]])
