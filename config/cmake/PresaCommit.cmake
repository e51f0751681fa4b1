cmake_minimum_required(VERSION 3.25)
# cmake -DSOURCE=folder -DFILE=commit.cpp -P PresaCommit.cmake: writes the commit of the source, at every build; empty where git does not
# know it. An unchanged file keeps its time, so that nothing is compiled again.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude=* --abbrev=12
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "")
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "#include \"apps/common/version.h\"\n\nconst char* const presa::kCommit = \"@commit@\";\n" @ONLY)
