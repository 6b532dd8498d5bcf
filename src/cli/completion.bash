# Completions of mdr-tui for bash: the program itself is asked.
_mdr_tui() {
    # Bash splits words at = and :, and leaves quotes in them. Here they are the words that the program would get.
    local line=${COMP_LINE:0:COMP_POINT} token blanks
    local -a words=()
    for token in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
        blanks=${line%%[![:space:]]*}
        line=${line#"$blanks"}
        [[ $line == "$token"* ]] || token=$line
        line=${line#"$token"}
        if [[ ${#words[@]} -eq 0 || -n $blanks ]]; then
            words+=("$token")
        else
            words[${#words[@]} - 1]+=$token
        fi
    done
    local typed=${words[${#words[@]} - 1]}
    words=("${words[@]//[\"\'\\]/}")
    # What bash takes for a word before the one that is completed is not part of the answer.
    local word=${words[${#words[@]} - 1]} known=
    if [[ $word == *[=:]* && $COMP_WORDBREAKS == *[=:]* ]]; then
        known=${word%"${word##*[=:]}"}
    fi
    local -a found=()
    IFS=$'\013' read -r -d '' -a found < <(
        MDR_TUI_COMPLETE=bash _CLAP_IFS=$'\013' _CLAP_COMPLETE_INDEX=$((${#words[@]} - 1)) \
            mdr-tui -- "${words[@]}" 2> /dev/null
    )
    local answer
    COMPREPLY=()
    for answer in "${found[@]}"; do
        answer=${answer#"$known"}
        # Within quotes a name stands as it is.
        [[ $typed == *[\"\']* ]] || printf -v answer %q "$answer"
        COMPREPLY+=("$answer")
    done
    if [[ ${#COMPREPLY[@]} -ne 1 || ${COMPREPLY[0]} != *[=/:] ]]; then
        compopt +o nospace 2> /dev/null
    fi
}
complete -o nospace -o bashdefault -o nosort -F _mdr_tui mdr-tui 2> /dev/null ||
    complete -o nospace -o bashdefault -F _mdr_tui mdr-tui
