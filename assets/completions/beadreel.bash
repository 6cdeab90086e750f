# bash completion for beadreel and beadsim: options and their values are those that the program names.
_beadreel()
{
    local cur prev words cword
    _init_completion -n = 2>/dev/null || { cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}; }
    local program=${COMP_WORDS[0]} option=$prev value=$cur prefix='' name letter argument values all=''
    if [[ $cur == --*=* ]]; then
        option=${cur%%=*} value=${cur#*=} prefix=$option=
    fi
    if [[ " ${COMP_WORDS[*]} " == *" --list keys "* || " ${COMP_WORDS[*]} " == *" --list=keys "* ]] && [[ $prev == *keys ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --list keys 2>/dev/null | sed -n '/^[a-z][^:]*: /{s/: .*//;s/[.()]/ /g;p}')" -- "$cur")
        return
    fi
    while read -r name letter argument values; do
        all+=" $name ${letter#..}"
        [[ $option == -* && ($option == "$name" || $option == "$letter") ]] || continue
        case $argument in
            .) ;;
            PATH | FILE) mapfile -t COMPREPLY < <(compgen -P "$prefix" -f -- "$value"); return ;;
            *) mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$values" -- "$value"); return ;;
        esac
    done < <("$program" --help=words 2>/dev/null)
    if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$all" -- "$cur")
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --list scenes 2>/dev/null | cut -d' ' -f1)" -- "$cur"; compgen -d -- "$cur"
        compgen -f -X '!*.@(yaml|yml|h5)' -- "$cur")
}
complete -o filenames -F _beadreel beadreel beadsim
