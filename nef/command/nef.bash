# SPDX-License-Identifier: Apache-2.0
#
# Completion of the program `nef` for bash: subcommands, flags, and files of the known formats.

_nef() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local commands='union intersection difference symdiff complement interior closure boundary exterior regularize
    transform info check equal locate ray convert eval'
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$word")
    return
  fi
  case $previous in
    --translate | --scale | --rotate | --matrix | --repeat) return ;;
  esac
  if [[ $word == -* ]]; then
    local flags='--help --json --quiet'
    [[ $command != check ]] && flags+=' --strict --as-surface'
    flags+=' --no-check'
    case $command in
      union | intersection | difference | symdiff | eval | complement | interior | closure | boundary | exterior | \
        regularize)
        flags+=' --output --exact --binary --repeat'
        ;;
      convert) flags+=' --output --exact --binary' ;;
      transform) flags+=' --output --exact --binary --translate --scale --rotate --matrix' ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$flags" -- "$word")
    return
  fi
  compopt -o filenames
  mapfile -t COMPREPLY < <(
    compgen -d -- "$word"
    compgen -f -X '!*.@(nef|nef3|off|obj|stl|ply)' -- "$word"
  )
}

complete -F _nef nef
