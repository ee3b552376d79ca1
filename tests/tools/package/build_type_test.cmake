# Configures the core without a build type, with an empty one, and as a part of another project; searches the compiler commands for -O3.
set(core -DSTRATA_CORE_ONLY=ON -DSTRATA_BUILD_TESTS=OFF -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER})

# expect(NAME WANTED SOURCE OPTION...): WANTED is whether the commands optimize.
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

# As a part of another project, only the library is built: neither tests nor the command.
list(REMOVE_ITEM core -DSTRATA_CORE_ONLY=ON -DSTRATA_BUILD_TESTS=OFF)
expect(whole_part FALSE ${FOLDER}/host)
file(READ ${FOLDER}/whole_part/compile_commands.json commands)
if(NOT commands MATCHES "tools/library" OR commands MATCHES "tools/strata/|${SOURCE}/tests/")
  message(FATAL_ERROR "as a part of another project: expected the library without tests and command")
endif()

# A parent that enables all warnings: its flags apply only to its own code. The test reads the compiler commands of a program that includes the
# library, and of a source of the library.
file(WRITE ${FOLDER}/strict/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(strict LANGUAGES CXX)\n"
  "set(CMAKE_EXPORT_COMPILE_COMMANDS ON)\nset(CMAKE_CXX_STANDARD 17)\n"
  "add_compile_options(-Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror)\n"
  "add_subdirectory(${SOURCE} strata)\nadd_executable(app main.cpp)\ntarget_link_libraries(app PRIVATE strata::library)\n")
file(WRITE ${FOLDER}/strict/main.cpp "#include <strata/strata.h>\nint main() { return strata::version().empty() ? 1 : 0; }\n")
expect(strict_part FALSE ${FOLDER}/strict)
file(READ ${FOLDER}/strict_part/compile_commands.json commands)
string(JSON count LENGTH "${commands}")
math(EXPR last "${count} - 1")
set(looked_at 0)
foreach(number RANGE ${last})
  string(JSON file GET "${commands}" ${number} file)
  if(NOT file MATCHES "strict/main\\.cpp$|rasterizer/set_up/clip\\.cpp$|rasterizer.*unity_0_cxx\\.cxx$")
    continue()
  endif()
  string(JSON command GET "${commands}" ${number} command)
  string(JSON folder GET "${commands}" ${number} directory)
  execute_process(COMMAND sh -c "${command} -fsyntax-only" WORKING_DIRECTORY ${folder} RESULT_VARIABLE status ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "as a part of a strict project: ${file} does not compile: ${out}")
  endif()
  math(EXPR looked_at "${looked_at} + 1")
endforeach()
if(looked_at LESS 2)
  message(FATAL_ERROR "as a part of a strict project: expected the program and a source of the library, found ${looked_at} of them")
endif()
