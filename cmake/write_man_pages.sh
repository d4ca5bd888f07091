#!/bin/sh
# write_man_pages.sh HELP2MAN PROGRAM VERSION FOLDER
#
# Writes FOLDER/packtrace.1, and FOLDER/packtrace-COMMAND.1 for each command, from their --help.
set -eu
help2man=$1
program=$2
version=$3
folder=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The program under its installed name, with its help as help2man reads it best: "-h, --help", and
# headings in small letters, which CLI11 2.5 capitalises. The terminal's width plays no part.
cat >"$work/packtrace" <<TEXT
#!/bin/sh
"$program" "\$@" | sed -e 's/^\(  -[A-Za-z0-9]\),--/\1, --/' -e 's/^Usage: [^ ]*/Usage: packtrace/' \
    -e 's/^OPTIONS:/Options:/' -e 's/^SUBCOMMANDS:/Subcommands:/' \
    -e 's/^POSITIONALS:/Positionals:/' -e 's/^  \([A-Za-z]*\) REQUIRED /  \1 /'
TEXT
chmod +x "$work/packtrace"
PATH=$work:$PATH
export PATH

# commands_of NAME: "  render     Render a scene to a picture" in the help of NAME becomes "NAME-render
# Render …"; those of that command follow. Builds without studies name the commands that they leave
# out; these have no page.
commands_of() {
    $(echo "$1" | tr - ' ') --help |
        sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\)  *\(.*\)/'"$1"'-\1 \2/p' |
        grep -v ' (not in this build' | while read -r name description; do
        echo "$name $description"
        commands_of "$name"
    done
}
commands_of packtrace >"$work/commands"
[ -s "$work/commands" ] || { echo "packtrace --help lists no commands" >&2; exit 1; }

# write_page NAME DESCRIPTION PROGRAM: `also` are the pages that it refers to.
write_page() {
    printf '[see also]\n%s\n' "$also" >"$work/also"
    "$help2man" --no-info --section 1 --name "$2" --version-string "packtrace $version" \
        --include "$work/also" --output "$work/$1.1" "$3"
    # What help2man makes of "packtrace render" in its first lines is "packtrace".
    sed -i -e "s/^\.TH PACKTRACE /.TH $(echo "$1" | tr '[:lower:]' '[:upper:]') /" \
        -e "/^\.SH NAME/,/^\.SH SYNOPSIS/s/^packtrace\(\\\\*\)\{0,1\} /$1 /" "$work/$1.1"
}

mkdir -p "$folder"
also=$(sed 's/^\([a-z-]*\) .*/.BR \1 (1)/; $!s/$/,/' "$work/commands")
write_page packtrace "trace rays through scenes of analytic surfaces, in packets" packtrace
also='.BR packtrace (1)'
while read -r name description; do
    write_page "$name" "$description" "$(echo "$name" | tr - ' ')"
done <"$work/commands"
rm -f "$folder"/packtrace*.1
cp "$work"/*.1 "$folder"
