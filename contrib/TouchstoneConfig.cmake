# SPDX-License-Identifier: LGPL-2.1-or-later
# find_package(Touchstone) gives the target Touchstone::touchstone: headers, library, and
# the flags of the deal.II that it was built with.
include(CMakeFindDependencyMacro)
find_dependency(deal.II 9.4)
# deal.II defines its targets no earlier than its own macros need them.
if(NOT DEAL_II_TARGET_CONFIG_INCLUDED)
  include(${DEAL_II_TARGET_CONFIG})
  set(DEAL_II_TARGET_CONFIG_INCLUDED TRUE)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/TouchstoneTargets.cmake)
