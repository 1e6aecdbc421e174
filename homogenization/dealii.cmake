# SPDX-License-Identifier: MIT
# homespun::dealii: deal.II as a target with keywords, which deal.II 9.4 itself does not offer. Read
# after find_package(deal.II), by homespun and by whoever uses its component homogenization, hence
# imported in both.
#   HOMESPUN_DEALII_FLAVOUR  RELEASE, or DEBUG for the build of deal.II with assertions
if(NOT TARGET homespun::dealii)
  include(${DEAL_II_TARGET_CONFIG})
  add_library(homespun::dealii INTERFACE IMPORTED)
  target_include_directories(homespun::dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
  target_compile_definitions(homespun::dealii INTERFACE
    ${DEAL_II_USER_DEFINITIONS} ${DEAL_II_USER_DEFINITIONS_${HOMESPUN_DEALII_FLAVOUR}})
  target_link_libraries(homespun::dealii INTERFACE ${DEAL_II_TARGET_${HOMESPUN_DEALII_FLAVOUR}})
endif()
