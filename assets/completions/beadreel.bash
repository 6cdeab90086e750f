# bash completion for beadreel and beadsim
_beadreel()
{
    local cur prev words cword
    _init_completion -n = 2>/dev/null || { cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}; }
    local program=${COMP_WORDS[0]}
    local option=$prev value=$cur prefix=
    if [[ $cur == --*=* ]]; then
        option=${cur%%=*} value=${cur#*=} prefix=$option=
    fi
    if [[ " ${COMP_WORDS[*]} " == *" --list keys "* || " ${COMP_WORDS[*]} " == *" --list=keys "* ]] && [[ $prev == *keys ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --list keys 2>/dev/null | sed -n '/^[a-z][^:]*: /{s/: .*//;s/[.()]/ /g;p}')" -- "$cur")
        return
    fi
    case $option in
        --list)
            mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$("$program" --help 2>/dev/null |
                sed -n 's/^ *--list [A-Z]* *list //p' | sed 's/,/ /g; s/ or / /')" -- "$value")
            return ;;
        --progress) mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "auto plain json none" -- "$value"); return ;;
        --instructions) mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "sse2 avx2 avx512" -- "$value"); return ;;
        --canvas) mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "plain osmesa egl" -- "$value"); return ;;
        --threads | --set | --only | --configuration | --shard) return ;;
        -o | --output | --info) mapfile -t COMPREPLY < <(compgen -P "$prefix" -f -- "$value"); return ;;
    esac
    if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "--output --set --only --plan --list --info --configuration --sheet --shard --merge --threads --instructions --canvas --progress \
            --help --version -o -h -V" -- "$cur")
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --list scenes 2>/dev/null | cut -d' ' -f1)" -- "$cur"; compgen -d -- "$cur"
        compgen -f -X '!*.@(yaml|yml|h5)' -- "$cur")
}
complete -o filenames -F _beadreel beadreel beadsim
