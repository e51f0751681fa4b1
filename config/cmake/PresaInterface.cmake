cmake_minimum_required(VERSION 3.25)
# cmake -DSOURCE=folder -DHEADERS=list.txt -DVERSION=x.y.z -DFILE=interface.cpp -P PresaInterface.cmake: writes the version of Presa and the hash of
# the listed headers. Comments and white space do not count: they change no plug-in. An unchanged file keeps its time.
file(STRINGS ${HEADERS} headers)
list(SORT headers)
set(all "")
foreach(header IN LISTS headers)
  file(READ ${SOURCE}/${header} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
  string(SHA256 hash "${text}")
  string(APPEND all "${header} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 12 hash)
file(CONFIGURE OUTPUT ${FILE} @ONLY CONTENT [[// Written by the build: what this file is compiled into was built against these headers of Presa.
extern "C" {
extern __attribute__((visibility("default"))) const char presa_plugin_interface[];
const char presa_plugin_interface[] = "Presa @VERSION@ (interface @hash@)";
}
]])
