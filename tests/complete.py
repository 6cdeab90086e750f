#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a shell makes of lines on a real terminal: complete.py SHELL SCRIPT LINE... prints each line after TAB.

The shell runs in a pseudo-terminal, without the user's settings, loads the completion SCRIPT and is typed at."""
import os
import pty
import re
import select
import sys
import time

# Each shell, what loads the script, and what sets its prompt. Where a prompt is, all that came before has been done: nothing here
# waits for a while to pass. Quotes part the words, so that the echo of what is typed is not taken for what is printed.
PROMPT = 'type> '
SHELLS = {
    'bash': (['bash', '--norc', '--noprofile', '-i'], 'bind "set enable-bracketed-paste off"; source {}', 'PS1="ty""pe> "'),
    'zsh': (['zsh', '-f', '-i'], 'bindkey -e; unsetopt zle_bracketed_paste; fpath=({dir} $fpath); '
            'autoload -Uz compinit; compinit -u -D', 'PS1="ty""pe> "'),
    'fish': (['fish', '--no-config', '-i'], 'source {}', 'function fish_prompt; echo -n "ty""pe> "; end'),
}


class Terminal:
    """A shell in a pseudo-terminal."""

    def __init__(self, command):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM='xterm', COLUMNS='200', LINES='50', HISTFILE='')
            os.execvp(command[0], command)
        self.seen = ''

    def type(self, text):
        os.write(self.fd, text.encode())

    def wait(self, pattern, seconds=60):
        """The first match of the pattern in what the shell prints from here on; what follows it is left for the next call."""
        end = time.monotonic() + seconds
        while not (found := re.search(pattern, self.seen)):
            if not select.select([self.fd], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError(f'{pattern!r} did not come: {self.seen!r}')
            try:
                self.seen += os.read(self.fd, 65536).decode(errors='replace')
            except OSError as ended:
                raise EOFError(f'the shell ended before {pattern!r} came: {self.seen!r}') from ended
        self.seen = self.seen[found.end():]
        return found

    def close(self):
        os.close(self.fd)
        os.waitpid(self.pid, 0)


def complete(shell, script, lines):
    command, load, prompt = SHELLS[shell]
    terminal = Terminal(command)
    try:
        terminal.type(f'{load.format(script, dir=os.path.dirname(os.path.abspath(script)))}; {prompt}\n')
        terminal.wait(PROMPT)
        for line in lines:
            # The shell takes what is typed in order: the rest of the line is read once TAB has done its work.
            terminal.type(line + '\t' + '\x01echo "<"\'\' \x05 ">"\n')
            yield terminal.wait(r'< ([^\r\n]*?) *>\r').group(1)
            terminal.wait(PROMPT)
    finally:
        terminal.close()


if __name__ == '__main__':
    for made in complete(*sys.argv[1:3], sys.argv[3:]):
        print(made)
