# SPDX-License-Identifier: MIT
"""Completion of the command line in bash: commands, then their options, else files."""

TEMPLATE = """\
# Completion of homespun in bash; zsh reads it after `autoload bashcompinit && bashcompinit`.
_homespun()
{{
  local word="${{COMP_WORDS[COMP_CWORD]}}" command="homespun" options="" commands="" n
  for ((n = 1; n < COMP_CWORD; ++n)); do
    case "$command ${{COMP_WORDS[n]}}" in
      {known}) command="$command ${{COMP_WORDS[n]}}" ;;
    esac
  done
  case "$command" in
{cases}
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  fi
}}
# Where nothing is listed, files.
complete -o bashdefault -o default -F _homespun homespun
"""


def bash_completion(program):
    """The script, for the program and every command below it."""
    commands = list(program.walk())
    known = "|".join(f'"{" ".join(command.words)}"' for command in commands[1:])
    cases = "\n".join(
        f'    "{" ".join(command.words)}")\n'
        f'      options="{" ".join(command.options())}"\n'
        f'      commands="{" ".join(below.words[-1] for below in command.commands)}" ;;'
        for command in commands
    )
    return TEMPLATE.format(known=known, cases=cases)
