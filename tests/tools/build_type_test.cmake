# Configures the core without a build type, with an empty one, and as a part of another project; looks for -O3 in the commands.
set(core -DSTRATA_CORE_ONLY=ON -DSTRATA_BUILD_TESTS=OFF -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER})

# expect(NAME WANTED SOURCE OPTION...): `WANTED` is whether the commands optimize.
function(expect name wanted source)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=CMAKE_BUILD_TYPE ${CMAKE_COMMAND} -S ${source} -B ${FOLDER}/${name} ${core}
    ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "configuring ${name} failed: ${out}")
  endif()
  file(READ ${FOLDER}/${name}/compile_commands.json commands)
  set(found FALSE)
  if(commands MATCHES " -O3 ")
    set(found TRUE)
  endif()
  if(NOT found STREQUAL wanted)
    message(FATAL_ERROR "${name}: expected that the commands have -O3: ${wanted}, found: ${found}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(WRITE ${FOLDER}/host/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(host LANGUAGES CXX)\n"
  "set(CMAKE_EXPORT_COMPILE_COMMANDS ON)\nadd_subdirectory(${SOURCE} strata)\n")
expect(alone TRUE ${SOURCE})
expect(empty FALSE ${SOURCE} -DCMAKE_BUILD_TYPE=)
expect(debug FALSE ${SOURCE} -DCMAKE_BUILD_TYPE=Debug)
expect(part FALSE ${FOLDER}/host)

# As a part, the whole project is its library: neither tests nor the command.
list(REMOVE_ITEM core -DSTRATA_CORE_ONLY=ON -DSTRATA_BUILD_TESTS=OFF)
expect(whole_part FALSE ${FOLDER}/host)
file(READ ${FOLDER}/whole_part/compile_commands.json commands)
if(NOT commands MATCHES "tools/library" OR commands MATCHES "tools/strata/|${SOURCE}/tests/")
  message(FATAL_ERROR "as a part of another project: expected the library without tests and command")
endif()
