#!/bin/sh
# Manual pages made from the program's own help by help2man: make_man_pages.sh PROGRAM FOLDER writes
# culet.1.gz and a page for each command.
set -eu
program=$1
folder=$2
mkdir -p "$folder"
version=$("$program" --version)
page() { # NAME SUMMARY WORDS...: the help of "culet WORDS"
    name=$1 summary=$2
    shift 2
    # help2man runs what it is given through the shell.
    help2man --no-info --no-discard-stderr --section=1 --source="$version" --manual="culet" \
        --version-string="$version" --name="$summary" --output="$folder/$name.1" "$program $*"
    # It takes every page for that of the program, and fills the lines of examples.
    title=$(echo "$name" | tr '[:lower:]' '[:upper:]')
    sed -i -e "s/^\\.TH CULET /.TH $title /" -e "s/^culet \\\\- /$name \\\\- /" \
        -e 's/^Examples:$/.SH EXAMPLES/' -e '/^\.SH EXAMPLES/,$ { s/^\.IP$/.nf/; s/^\.PP$/.fi/ }' "$folder/$name.1"
    gzip -9nf "$folder/$name.1"
}
page culet "fit, render and compare models of cut gemstones"
"$program" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print } on && /^$/ { exit }' |
    while read -r command summary; do
        page "culet-$command" "${summary:-a command of culet}" "$command" </dev/null
    done
