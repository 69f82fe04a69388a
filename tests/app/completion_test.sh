#!/bin/bash
# What bash offers after words that were typed, and that every option of the help is offered:
# completion_test.sh COMPLETION PROGRAM
set -u
# shellcheck source=/dev/null
source "$1"
program=$2
bad=0
offered() { # EXPECTED TYPED...: is the expected word offered for the last of the typed ones?
    local expected=$1
    shift
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    COMPREPLY=()
    _culet
    case " ${COMPREPLY[*]} " in
        *" $expected "*) ;;
        *) echo "\"$*\" does not offer $expected, but: ${COMPREPLY[*]}" && bad=1 ;;
    esac
}
offered register culet re
offered --report culet fit stone.toml --re
offered residual culet fit stone.toml --paint re
offered reference culet render scene.toml --engine ref
offered estimate culet render scene.toml --check ""

count=0
for command in $("$program" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 } on && /^$/ { exit }'); do
    offered "$command" culet "${command:0:2}"
    for option in $("$program" "$command" --help | awk '/^  -/ { print $1 }' | tr ',' ' '); do
        offered "$option" culet "$command" "${option:0:3}"
        count=$((count + 1))
    done
done
[ "$count" -ge 150 ] || { echo "only $count options were found in the help" && bad=1; }
exit $bad
