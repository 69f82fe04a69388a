#!/bin/sh
# Completion of commands, options and their values for bash and zsh, made from the program's own help:
# make_completion.sh PROGRAM FOLDER writes FOLDER/culet (bash) and FOLDER/_culet (zsh).
# shellcheck disable=SC2016  # what is written here is expanded by the shell that completes
set -eu
program=$1
folder=$2
mkdir -p "$folder"
table=$folder/options.txt # command, option, values that it may have; a line each
: >"$table"

"$program" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 } on && /^$/ { exit }' >"$folder/commands.txt"
while read -r command; do
    # "  -o,--output FILE   words": an option of its own or, where the words are long, with them in the next line.
    "$program" "$command" --help | awk -v command="$command" '
        function put() {
            if (names == "") return
            values = ""
            if (match(rest, /\{[^}]*\}/)) {
                values = substr(rest, RSTART + 1, RLENGTH - 2)
                gsub(/,/, " ", values)
            } else if (names ~ /^--(light|engine|effects|tonemap)$/ &&
                       match(words, /^[a-z0-9]+(, [a-z0-9]+)(, [a-z0-9]+)+/)) {
                values = substr(words, RSTART, RLENGTH)
                gsub(/,/, "", values)
                sub(/ or$/, "", values)
            }
            n = split(names, name, ",")
            for (i = 1; i <= n; ++i) print command, name[i], values
            names = ""
        }
        /^  -/ {
            put()
            names = $1
            line = $0
            sub(/^  [^ ]+ ?/, "", line)
            at = match(line, /  +/)
            rest = at ? substr(line, 1, at - 1) : line
            words = at ? substr(line, at + RLENGTH) : ""
            next
        }
        /^      / && names != "" { line = $0; sub(/^ +/, "", line); words = words (words == "" ? "" : " ") line; next }
        { put() }
        END { put() }' >>"$table"
done <"$folder/commands.txt"
commands=$(tr '\n' ' ' <"$folder/commands.txt")

{
    echo '# bash completion of culet; made from its help by cmake/manuals/make_completion.sh'
    echo '_culet() {'
    echo '    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= word words='
    echo '    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do'
    echo '        case $word in -*) ;; *) command=$word; break ;; esac'
    echo '    done'
    echo '    if [[ -z $command ]]; then'
    echo "        COMPREPLY=(\$(compgen -W '$commands--help --version' -- \"\$cur\"))"
    echo '        return'
    echo '    fi'
    echo '    case $command,$prev in'
    awk 'NF > 2 { values = $3; for (i = 4; i <= NF; ++i) values = values " " $i
                  printf "        %s,%s) words=\"%s\" ;;\n", $1, $2, values }' "$table"
    echo '    esac'
    echo '    if [[ -n $words ]]; then'
    echo '        COMPREPLY=($(compgen -W "$words" -- "$cur"))'
    echo '        return'
    echo '    fi'
    echo '    if [[ $cur != -* ]]; then'
    echo '        mapfile -t COMPREPLY < <(compgen -f -- "$cur")'
    echo '        return'
    echo '    fi'
    echo '    case $command in'
    while read -r command; do
        options=$(awk -v command="$command" '$1 == command { printf "%s ", $2 }' "$table")
        echo "        $command) words=\"${options% }\" ;;"
    done <"$folder/commands.txt"
    echo '    esac'
    echo '    COMPREPLY=($(compgen -W "$words" -- "$cur"))'
    echo '}'
    echo 'complete -o filenames -F _culet culet'
} >"$folder/culet"

{
    echo '#compdef culet'
    echo '# zsh completion of culet; made from its help by cmake/manuals/make_completion.sh'
    echo 'local -a words_of; local command=$words[2] before=$words[CURRENT-1]'
    echo 'if (( CURRENT == 2 )); then'
    echo "    compadd -- ${commands}--help --version"
    echo '    return'
    echo 'fi'
    echo 'case $command,$before in'
    awk 'NF > 2 { values = $3; for (i = 4; i <= NF; ++i) values = values " " $i
                  printf "    %s,%s) words_of=(%s) ;;\n", $1, $2, values }' "$table"
    echo 'esac'
    echo 'if (( $#words_of )); then'
    echo '    compadd -- $words_of'
    echo '    return'
    echo 'fi'
    echo 'if [[ $PREFIX != -* ]]; then'
    echo '    _files'
    echo '    return'
    echo 'fi'
    echo 'case $command in'
    while read -r command; do
        options=$(awk -v command="$command" '$1 == command { printf "%s ", $2 }' "$table")
        echo "    $command) words_of=(${options% }) ;;"
    done <"$folder/commands.txt"
    echo 'esac'
    echo 'compadd -- $words_of'
} >"$folder/_culet"
