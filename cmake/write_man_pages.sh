#!/bin/sh
# write_man_pages.sh HELP2MAN PROGRAM NAME VERSION FOLDER DESCRIPTION [PAGE…]
#
# Writes FOLDER/NAME.1, and FOLDER/NAME-COMMAND.1 for each command, from their --help. NAME.1 refers
# to the other PAGEs.
set -eu
help2man=$1
program=$2
name=$3
version=$4
folder=$5
about=$6
shift 6
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The program under its installed name, with its help adapted to help2man: "-h, --help", and
# headings in lower case, which CLI11 2.5 capitalises. The terminal's width has no influence.
cat >"$work/$name" <<TEXT
#!/bin/sh
"$program" "\$@" | sed -e 's/^\(  -[A-Za-z0-9]\),--/\1, --/' -e 's/^Usage: [^ ]*/Usage: $name/' \
    -e 's/^OPTIONS:/Options:/' -e 's/^SUBCOMMANDS:/Subcommands:/' \
    -e 's/^POSITIONALS:/Positionals:/' -e 's/^  \([A-Za-z]*\) REQUIRED /  \1 /'
TEXT
chmod +x "$work/$name"
PATH=$work:$PATH
export PATH

# words_of PAGE: the command as typed; "packtrace-generate-random" gives "packtrace generate
# random".
words_of() {
    echo "$name$(echo "${1#"$name"}" | tr - ' ')"
}

# commands_of PAGE: "  render     Render a scene to a picture" in the help of PAGE becomes
# "PAGE-render Render …"; the subcommands of that command follow. Builds without studies still name
# the omitted commands in their help; these have no page.
commands_of() {
    $(words_of "$1") --help |
        sed -n '/^Subcommands:/,$s/^  \([a-z][a-z]*\)  *\(.*\)/'"$1"'-\1 \2/p' |
        grep -v ' (not in this build' | while read -r page description; do
        echo "$page $description"
        commands_of "$page"
    done
}
commands_of "$name" >"$work/commands"
[ -s "$work/commands" ] || { echo "$name --help lists no commands" >&2; exit 1; }

# write_page PAGE DESCRIPTION: `also` contains the pages that it refers to.
write_page() {
    printf '[see also]\n%s\n' "$also" >"$work/also"
    "$help2man" --no-info --section 1 --name "$2" --version-string "$name $version" \
        --include "$work/also" --output "$work/$1.1" "$(words_of "$1")"
    # In its first lines help2man shortens "packtrace render" to "packtrace".
    upper=$(echo "$name" | tr '[:lower:]' '[:upper:]')
    sed -i -e "s/^\.TH $upper /.TH $(echo "$1" | tr '[:lower:]' '[:upper:]') /" \
        -e "/^\.SH NAME/,/^\.SH SYNOPSIS/s/^$(echo "$name" | sed 's/-/\\\\*-/')\(\\\\*\)\{0,1\} /$1 /" \
        "$work/$1.1"
}

mkdir -p "$folder"
also=$({ sed 's/ .*//' "$work/commands"; [ $# = 0 ] || printf '%s\n' "$@"; } |
    sed 's/.*/.BR & (1)/; $!s/$/,/')
write_page "$name" "$about"
also=".BR $name (1)"
while read -r page description; do
    write_page "$page" "$description"
done <"$work/commands"
rm -f "$folder/$name"*.1
cp "$work"/*.1 "$folder"
