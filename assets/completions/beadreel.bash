# SPDX-License-Identifier: GPL-3.0-or-later
# bash completion for beadreel and beadsim: options and their values are those that the program names (--help=words).
_beadreel()
{
    local program=${COMP_WORDS[0]} cur=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}
    local value=$cur prefix='' name letter argument values all='' line=" ${COMP_WORDS[*]:0:COMP_CWORD} "
    # Bash breaks words at `=`, and replaces what stands behind it only; where COMP_WORDBREAKS has no `=`, the whole word.
    if [[ $cur == = ]]; then
        value=''
    elif [[ $option == = ]]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif [[ $cur == --*=* ]]; then
        option=${cur%%=*} value=${cur#*=} prefix=$option=
    fi
    COMPREPLY=()
    if [[ $line == *" --list keys " || $line == *" --list = keys " || $line == *" --list=keys " ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --list keys 2>/dev/null | sed -n '/^[a-z][^:]*: /{s/: .*//;s/[.()]/ /g;p}')" -- "$cur")
        return
    fi
    while IFS=$'\t' read -r line _; do
        read -r name letter argument values <<<"$line"
        all+=" $name ${letter#..}"
        [[ $option == -* && ($option == "$name" || $option == "$letter") ]] || continue
        case $argument in
            .) ;;
            PATH | FILE)
                compopt -o filenames 2>/dev/null
                mapfile -t COMPREPLY < <(compgen -P "$prefix" -f -- "$value")
                return ;;
            *) mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$values" -- "$value"); return ;;
        esac
    done < <("$program" --help=words 2>/dev/null)
    if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$all" -- "$cur")
    elif [[ $cur != = && ${COMP_WORDS[COMP_CWORD - 1]} != = ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --list scenes 2>/dev/null | cut -d' ' -f1)" -- "$cur"; compgen -d -- "$cur"
            compgen -f -- "$cur" | grep -E '[.](yaml|yml|h5)$')
    fi
}
complete -F _beadreel beadreel beadsim
