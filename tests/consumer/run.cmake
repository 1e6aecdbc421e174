# SPDX-License-Identifier: MIT
# The installed library as a user meets it: installs homespun into the build tree, configures and
# builds the consumer against that alone, runs it. The consumer is never compiled with
# -march=native, homespun mostly is: if both did not allocate alike, it would die in free().
#   BUILD     build tree of homespun         CONSUMER  folder of the consumer
#   WORK      where all this happens         MAKE_CELL program that writes a cell file
#   SETTINGS  generator, compiler and flags of the consumer
#   WITH_DEALII whether homogenization was built
function(run what)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
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

# Who asks for little needs little: neither deal.II nor HDF5 is looked for.
set(without -D CMAKE_DISABLE_FIND_PACKAGE_deal.II=ON
  -D CMAKE_DISABLE_FIND_PACKAGE_HDF5=ON -D CMAKE_DISABLE_FIND_PACKAGE_MPI=ON)
run("configure with shell and localization alone"
  ${CMAKE_COMMAND} -S ${CONSUMER}/components -B ${WORK}/components
  ${settings} ${without} -D COMPONENTS=shell,localization)

# refused(WHAT COMPONENTS MESSAGE): configuring with these components must fail with this message.
function(refused what components message)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CONSUMER}/components -B ${WORK}/refused
    ${settings} -D COMPONENTS=${components}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " text "${output}") # CMake breaks lines
  if(status EQUAL 0 OR NOT text MATCHES "${message}")
    message(FATAL_ERROR "${what} were not refused by name:\n${output}")
  endif()
endfunction()
string(CONCAT expected "has no component looms, weave; expected some of "
  "meshes, garment, shell, contact, localization, cell_file")
refused("components that homespun has not" shell,looms,weave "${expected}")

if(WITH_DEALII)
  # layered.prm: soft and hard stripes across axis 2, hence C22 = 1 / <1/D>, D = E h / (1 - nu^2) of
  # 1e6 Pa and 1e7 Pa.
  run("configure a program that homogenizes"
    ${CMAKE_COMMAND} -S ${CONSUMER}/homogenization -B ${WORK}/homogenization ${settings})
  run("build a program that homogenizes" ${CMAKE_COMMAND} --build ${WORK}/homogenization)
  run("homogenize" ${WORK}/homogenization/stiffness ${CONSUMER}/../../meshes/cells/layered.prm)
  if(NOT output MATCHES "[ \n]99[89]\\.?[0-9]*[ \n]")
    message(FATAL_ERROR
      "C22 of layered.prm is 999.0 N/m in closed form, the program says:\n${output}")
  endif()
  # A mesh that Python converts, in stripes of 3/8 and 5/8: C22 = 1255.89 N/m.
  file(COPY ${CONSUMER}/../homogenization/cell/data/halves.vtk DESTINATION ${WORK})
  file(WRITE ${WORK}/halves.prm "set Mesh = halves.vtk\nset Length unit = 0.01\n"
    "set Young's modulus = 7: 1e6, 3: 1e7\nset Poisson's ratio = 7: 0.3, 3: 0.3\n"
    "set Thickness = 7: 5e-4, 3: 5e-4\nset Density = 7: 400, 3: 400\n")
  run("homogenize a cell in .vtk" ${WORK}/homogenization/stiffness ${WORK}/halves.prm)
  if(NOT output MATCHES "[ \n]1255\\.?[0-9]*[ \n]")
    message(FATAL_ERROR
      "C22 of halves.vtk is 1255.89 N/m in closed form, the program says:\n${output}")
  endif()
else()
  string(CONCAT expected "has no component homogenization; .*built without deal.II, .* "
    "build homespun with -D HOMESPUN_WITH_DEALII=ON")
  refused("components that were not built" "homogenization" "${expected}")
endif()

run("make a cell" ${MAKE_CELL} ${WORK}/cell.h5)
run("up-sample in one call" ${WORK}/build/one_call ${WORK}/cell.h5)
run("run the consumer" ${WORK}/build/consumer ${WORK}/cell.h5
  ${prefix}/share/homespun/scenes/skirt.obj ${WORK}/skirt.ply)
message("${output}")
if(NOT output MATCHES "([0-9]+) fine triangles")
  message(FATAL_ERROR "the consumer does not say how many fine triangles it made")
endif()
set(n_fine ${CMAKE_MATCH_1})
file(READ ${WORK}/skirt.ply header LIMIT 400)
if(NOT header MATCHES "element face ${n_fine}")
  message(FATAL_ERROR
    "skirt.ply has not the ${n_fine} triangles that the consumer made:\n${header}")
endif()
