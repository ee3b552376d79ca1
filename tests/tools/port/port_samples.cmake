# Renders the kit on llvmpipe with 4 samples per pixel, and compares each sample's coverage with exact edges.
file(REMOVE_RECURSE "${OUT}")
foreach(command "${STRATA};probe;-o;${OUT}/kit" "${PROBE};${OUT}/kit;-o;${OUT}/answers;--driver;llvmpipe;--samples;4"
        "${PYTHON};-B;${JUDGE};${OUT}/kit;${OUT}/answers")
  execute_process(COMMAND ${command} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${command}: exit status ${status}")
  endif()
endforeach()
