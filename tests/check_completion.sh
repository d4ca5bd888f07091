#!/bin/sh
# check_completion.sh PACKTRACE
#
# bash, zsh and fish complete the program's words with the completion scripts that the program
# prints.
set -u
packtrace=$1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
touch "$folder/a scene.scene"
cd "$folder" || exit 1
failed=0
for shell in bash zsh fish; do
    command -v $shell >/dev/null || { echo "$shell is missing; type: sudo apt-get install $shell"; exit 1; }
    "$packtrace" completion $shell >"$folder/completion.$shell" || exit 1
    [ -s "$folder/completion.$shell" ] || { echo "no completion for $shell"; exit 1; }
done

# Each script prints the candidates for the last word of a line, one per line.
cat >"$folder/complete.bash" <<'TEXT'
source completion.bash
line=$1
# Splits the line as readline does.
mapfile -t COMP_WORDS < <(sed -e 's/=/ = /g' <<<"$line" | xargs -n 1; [[ $line != *\  ]] || echo)
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_packtrace
printf '%s\n' "${COMPREPLY[@]}"
TEXT
cat >"$folder/complete.fish" <<'TEXT'
source completion.fish
complete -C $argv[1] | string replace -r '\t.*' ''
TEXT
# Opens a pseudo-terminal for zsh and types the key that lists all choices.
cat >"$folder/complete.zsh" <<'TEXT'
zmodload zsh/zpty
zpty shell 'PS1= TERM=dumb zsh -f -i'
zpty -w shell "cd '$PWD'; autoload -Uz compinit; compinit -u -D; source ./completion.zsh"
zpty -w shell "list() { zle list-choices; zle -R; print LIS''TED }; zle -N list; bindkey '^I' list"
zpty -w shell 'LISTMAX=1000; print REA""DY'
zpty -r shell output '*READY*'
zpty -w -n shell "$1"$'\t'
zpty -r shell output '*LISTED*'
# Without the line itself.
print -r -- $output | grep -v 'packtrace '
zpty -d shell
TEXT
complete() {
    case $1 in
    bash) bash --norc "$folder/complete.bash" "$2" ;;
    fish) HOME=$folder fish --no-config "$folder/complete.fish" "$2" ;;
    zsh) HOME=$folder timeout 60 zsh -f "$folder/complete.zsh" "$2" ;;
    esac
}

# completes LINE WORD…: checks that each shell offers every WORD, and for `!WORD` that it does not.
completes() {
    line=$1
    shift
    for shell in bash zsh fish; do
        complete $shell "$line" >"$folder/offered" 2>&1
        for word in "$@"; do
            case $word in
            !*) ! grep -q -e "${word#!}" "$folder/offered" ;;
            *) grep -q -e "$word" "$folder/offered" ;;
            esac && continue
            echo "$shell, '$line': wants $word of"
            cat "$folder/offered"
            failed=1
        done
    done
}

completes 'packtrace ' render compare intersect '!completion'
completes 'packtrace ren' render '!compare'
completes 'packtrace render --acc' accuracy '!traversal'
completes 'packtrace render --accuracy ' fast exact '!scene'
completes 'packtrace render --accuracy=' fast exact '!scene'
# All instruction sets of `packtrace info`, whether they run here or not.
isas=$("$packtrace" info | sed -n '/^instruction set/,/^$/s/^\([a-z0-9_]*\)  .*/\1/p')
completes 'packtrace render --isa ' auto $isas '!scene'
completes 'packtrace render --width ' 16 '!scene'
completes 'packtrace render --precision ' single double extended
completes 'packtrace render --traversal ' auto list tree
completes 'packtrace intersect --precision ' single '!extended'
if "$packtrace" stress --help | grep -q -e --family; then
    completes 'packtrace stress --mode ' fast exact
    completes 'packtrace stress --family ' tiny-far '!scene'
    completes 'packtrace bench --isa ' auto $isas
fi
completes 'packtrace onedim --solver ' bitsliced
completes 'packtrace render x -o ' 'a.*scene'
completes 'packtrace render ' 'a.*scene'
completes 'packtrace render --size ' '!scene'
completes 'packtrace generate ' sphereflake lattice '!render'
completes 'packtrace generate lattice --e' edge '!depth'

# Every long option in the help of every command.
commands=$("$packtrace" --help | sed -n '/^S[Uu][Bb]/,$s/^  \([a-z][a-z]*\) .*/\1/p')
for command in $commands; do
    options=$("$packtrace" "$command" --help | sed -n 's/^  \(-.,\)\{0,1\}--\([a-z0-9-]*\).*/\2/p')
    for shell in bash fish; do
        complete $shell "packtrace $command --" >"$folder/offered"
        for option in $options; do
            grep -q -x -e "--$option" "$folder/offered" && continue
            echo "$shell does not offer packtrace $command --$option"
            failed=1
        done
    done
done
[ "$failed" = 0 ] && echo "bash, zsh and fish complete $(echo "$commands" | wc -w) commands"
exit "$failed"
