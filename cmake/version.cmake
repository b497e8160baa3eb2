# Writes OUTPUT, a source with the version of the tree in SOURCE: RELEASE where the tag vRELEASE stands on a clean tree, else
# RELEASE+COMMIT, with .dirty behind it if a tracked source has changed or there is another .cpp or .h. What git archive exports knows its commit as well. A commit may
# be rewritten into another one with the same files, so beside it stands what those were: SHA1 of the list of all but results/
# and .ci/.
set(commit "unknown")
set(sources "unknown")
set(archived "$Format:%h$")
if(NOT archived MATCHES Format)
  set(commit ${archived})
endif()

function(git result)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE output RESULT_VARIABLE status
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status)
    set(output "")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

# A copy inside a foreign repository is not of that repository's commit.
git(root rev-parse --show-toplevel)
get_filename_component(source ${SOURCE} REALPATH)
if(root AND root STREQUAL source)
  git(commit rev-parse --short=10 HEAD)
  git(files ls-tree -r HEAD)
  string(REGEX REPLACE "[^\n]*\t(results|\\.ci)/[^\n]*\n" "" files "${files}\n")
  string(SHA1 sources "${files}")
  string(SUBSTRING ${sources} 0 10 sources)
  git(tags tag --points-at HEAD)
  git(changed status --porcelain --untracked-files=no -- . :!results :!.ci)
  git(added ls-files --others --exclude-standard -- *.cpp *.h)
endif()
set(version "${RELEASE}+${commit}")
if(changed OR added)
  string(APPEND version ".dirty")
elseif("${tags}" MATCHES "(^|\n)v${RELEASE}(\n|$)")
  set(version ${RELEASE})
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
[[namespace maxwrench {

const char* version();
const char* version() { return "@version@"; }

const char* sources_id();
const char* sources_id() { return "@sources@"; }

}  // namespace maxwrench
]])
