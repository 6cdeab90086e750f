# SPDX-License-Identifier: GPL-3.0-or-later
# fish completion for beadreel and beadsim: options, their values and their help are those that the program names (--help=words).

# Ready scenes, scene files and results; behind `--list keys`, parts of a scene.
function __beadreel_inputs --argument-names program
    string match --quiet -- '-*' (commandline --current-token); and return
    set --local line " "(string join -- ' ' (commandline --tokenize --cut-at-cursor --current-process))" "
    if string match --quiet --regex -- ' --list[ =]keys $' $line
        $program --list keys 2>/dev/null | string match --regex '^[a-z][^:]*(?=: )' | string replace --all --regex '[.() ]+' \n
        return
    end
    $program --list scenes 2>/dev/null | string replace --regex '  +' \t
    __fish_complete_suffix .yaml .yml .h5
end

for program in beadreel beadsim
    complete --command $program --erase
    command --query $program; or continue
    complete --command $program --no-files --arguments "(__beadreel_inputs $program)"
    $program --help=words 2>/dev/null | while read --local --delimiter \t line help
        set --local fields (string split ' ' -- $line)
        set --local option --long-option (string sub --start 3 -- $fields[1])
        if test $fields[2] != ..
            set --append option --short-option (string sub --start 2 -- $fields[2])
        end
        switch $fields[3]
            case .
            case PATH FILE
                set --append option --require-parameter --force-files
            case '*'
                set --append option --exclusive --arguments "$fields[4..-1]"
        end
        complete --command $program $option --description "$help"
    end
end
