#include "cli/tools/completion/shell_scripts.h"

namespace lockstep::host {

// bash splits words at = and : too, and replaces the last part only.
const char* const kBashCompletion =
    R"script(# bash completion of lockstep: eval "$(lockstep completion bash)"
_lockstep() {
  local line=${COMP_LINE:0:COMP_POINT} words=() word i candidate files='' suffix found=()
  for ((i = 0; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    ((i < COMP_CWORD)) || word=${word:0:${#line}}
    if ((i > 0)) && [[ $line != [[:space:]]* ]] && { [[ $word == [=:]* ]] || [[ ${words[-1]} == *[=:] ]]; }; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
    line=${line#"${line%%[![:space:]]*}"}
    line=${line#"$word"}
  done
  word=${words[-1]}
  local typed=${COMP_WORDS[COMP_CWORD]}
  [[ $typed == [=:] ]] && typed=''
  local before=${word%"$typed"}
  COMPREPLY=()
  while IFS=$'\t' read -r candidate _; do
    case $candidate in
      :*) files=$candidate ;;
      *)
        [[ $candidate == *[=:] ]] && compopt -o nospace
        COMPREPLY+=("${candidate#"$before"}")
        ;;
    esac
  done < <("${words[0]}" completion words lockstep "${words[@]:1}" 2>/dev/null)
  [[ -n $files ]] || return 0
  compopt -o filenames
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$word")
  [[ $files == :files* ]] || return 0
  while IFS= read -r candidate; do
    [[ -d $candidate ]] && continue
    found=(${files#:files})
    ((${#found[@]})) || COMPREPLY+=("$candidate")
    for suffix in "${found[@]}"; do
      [[ $candidate == *."$suffix" ]] && COMPREPLY+=("$candidate")
    done
  done < <(compgen -f -- "$word")
  return 0
}
complete -F _lockstep lockstep
)script";

const char* const kZshCompletion = R"script(#compdef lockstep
# zsh completion of lockstep: eval "$(lockstep completion zsh)" behind compinit
_lockstep() {
  local line files='' candidate about
  local -a found open described
  for line in "${(@f)$("${words[1]}" completion words lockstep "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
    candidate=${line%%$'\t'*}
    about=${line#*$'\t'}
    if [[ $candidate == :* ]]; then
      files=$candidate
    elif [[ $candidate == *[=:] ]]; then
      open+=("$candidate")
    elif [[ -n $candidate ]]; then
      found+=("$candidate")
      [[ $about != $line && -n $about ]] && described+=("$candidate  -- $about") || described+=("$candidate")
    fi
  done
  ((${#found})) && compadd -l -d described -a found
  ((${#open})) && compadd -S '' -a open
  case $files in
    :directories) _files -/ ;;
    :files) _files ;;
    :files*) _files -g "*.(${${files#:files }// /|})(-.)" ;;
  esac
  return 0
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _lockstep "$@"
else
  compdef _lockstep lockstep
fi
)script";

const char* const kFishCompletion =
    R"script(# fish completion of lockstep: lockstep completion fish | source
function __lockstep_candidates
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    set -l lines ($words[1] completion words lockstep $words[2..-1] "$word" 2>/dev/null)
    for line in $lines
        switch $line
            case ':directories'
                __fish_complete_directories "$word"
            case ':files'
                __fish_complete_path "$word"
            case ':files *'
                for suffix in (string split ' ' -- (string replace ':files ' '' -- $line))
                    __fish_complete_suffix "$word" .$suffix
                end
            case '*'
                printf '%s\n' $line
        end
    end
end
complete -c lockstep -f -a '(__lockstep_candidates)'
)script";

}  // namespace lockstep::host
