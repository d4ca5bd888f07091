# Writes OUTPUT: the facts about a build that measurements report. Every build calls this script, so
# that the commit is that of the sources when they were built. OUTPUT is untouched if nothing
# changed. Variables: SOURCE, OUTPUT, FLAGS.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND git -C ${SOURCE} rev-parse --short HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE failed)
if(failed)
    set(commit unknown)
else()
    # Changes of results and documents do not count: the program does not depend on them.
    execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD -- . ":(exclude)results"
                            ":(exclude)docs" ":(exclude)*.md"
                    RESULT_VARIABLE differs ERROR_QUIET)
    if(differs)
        string(APPEND commit -dirty)
    endif()
endif()
# A digest of the files themselves: a commit does not cover uncommitted changes. Kernels are
# excluded: cached truths do not depend on them, and they change most often.
file(GLOB_RECURSE sources RELATIVE ${SOURCE} ${SOURCE}/src/* ${SOURCE}/include/*)
list(FILTER sources EXCLUDE REGEX "^src/kernels/")
list(SORT sources)
set(digests "")
foreach(source IN LISTS sources)
    file(SHA256 ${SOURCE}/${source} digest)
    string(APPEND digests "${source} ${digest}\n")
endforeach()
string(SHA256 sources_digest "${digests}")

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"#include \"lab/harness/machine.hpp\"

namespace packtrace {

const char* const built_commit = \"@commit@\";
const char* const built_sources = \"@sources_digest@\";
const char* const kernel_flags = \"@FLAGS@\";

}  // namespace packtrace
")
