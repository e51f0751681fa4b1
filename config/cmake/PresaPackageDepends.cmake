# CPack runs this over the staged files: the libraries of other packages that the programs and plug-ins need. CPack's own search starts two
# programs for each of a thousand files, a minute; this looks into those that can have any.
set(prefix ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX})
file(GLOB binaries ${prefix}/bin/* ${prefix}/lib/presa/*.so ${prefix}/lib/presa/presa_supervisor)
set(work ${CPACK_TOPLEVEL_DIRECTORY}/depends)
file(WRITE ${work}/debian/control "Source: presa\n\nPackage: presa\nArchitecture: any\n") # dpkg-shlibdeps asks for one
execute_process(COMMAND dpkg-shlibdeps --ignore-missing-info -l${prefix}/lib/presa -O ${binaries} WORKING_DIRECTORY ${work}
  OUTPUT_VARIABLE found ERROR_VARIABLE problems COMMAND_ERROR_IS_FATAL ANY)
if(NOT found MATCHES "shlibs:Depends=([^\n]+)")
  message(FATAL_ERROR "dpkg-shlibdeps names no package: ${found}${problems}")
endif()
string(PREPEND CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}, ")
