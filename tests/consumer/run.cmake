# SPDX-License-Identifier: MIT
# The installed library as a user meets it: installs homespun into the build tree, configures and builds
# the consumer against that alone, runs it. The consumer is never compiled with -march=native, homespun
# mostly is: if both did not allocate alike, it would die in free().
#   BUILD     build tree of homespun         CONSUMER  folder of the consumer
#   WORK      where all this happens         MAKE_CELL program that writes a cell file
#   SETTINGS  generator, compiler and flags of the consumer
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "could not ${what} (${status}):\n  ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component library)
set(settings -D CMAKE_PREFIX_PATH=${prefix} ${SETTINGS})
run("configure the consumer" ${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build ${settings})
run("build the consumer" ${CMAKE_COMMAND} --build ${WORK}/build)

# Components that homespun has not are refused, all of them by name.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${CONSUMER}/unknown -B ${WORK}/unknown ${settings}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
string(REGEX REPLACE "[ \n]+" " " message "${output}") # CMake breaks lines
if(status EQUAL 0 OR NOT message MATCHES "has no component looms, weave; expected some of meshes, shell, localization, cell_file")
  message(FATAL_ERROR "components that homespun has not were not refused by name:\n${output}")
endif()

run("make a cell" ${MAKE_CELL} ${WORK}/cell.h5)
run("run the consumer" ${WORK}/build/consumer ${WORK}/cell.h5 ${prefix}/share/homespun/scenes/skirt.obj ${WORK}/skirt.ply)
message("${output}")
if(NOT output MATCHES "([0-9]+) fine triangles")
  message(FATAL_ERROR "the consumer does not say how many fine triangles it made")
endif()
set(n_fine ${CMAKE_MATCH_1})
file(READ ${WORK}/skirt.ply header LIMIT 400)
if(NOT header MATCHES "element face ${n_fine}")
  message(FATAL_ERROR "skirt.ply has not the ${n_fine} triangles that the consumer made:\n${header}")
endif()
