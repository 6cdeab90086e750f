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

SHELLS = {
    'bash': (['bash', '--norc', '--noprofile', '-i'], 'bind "set enable-bracketed-paste off"; source {}'),
    'zsh': (['zsh', '-f', '-i'], 'bindkey -e; unsetopt zle_bracketed_paste; fpath=({dir} $fpath); '
            'autoload -Uz compinit; compinit -u -D'),
    'fish': (['fish', '--no-config', '-i'], 'source {}'),
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

    def wait(self, pattern, seconds=20):
        """The last match of the pattern in what the shell prints from here on; it has printed nothing more for a moment."""
        end, found = time.monotonic() + seconds, None
        while time.monotonic() < end:
            if select.select([self.fd], [], [], 0.3)[0]:
                try:
                    self.seen += os.read(self.fd, 65536).decode(errors='replace')
                except OSError:
                    break
                found = re.search(pattern, self.seen)
            elif found:
                break
        if not found:
            raise TimeoutError(f'{pattern!r} did not come: {self.seen!r}')
        self.seen = ''
        return found

    def close(self):
        os.close(self.fd)
        os.waitpid(self.pid, 0)


def complete(shell, script, lines):
    command, load = SHELLS[shell]
    terminal = Terminal(command)
    try:
        # Typed text is echoed; a word in two pieces comes once only.
        terminal.type(load.format(script, dir=os.path.dirname(os.path.abspath(script))) + '; echo rea""dy\n')
        terminal.wait('ready')
        for line in lines:
            terminal.type(line + '\t')
            terminal.wait('.')
            terminal.type('\x01echo "<"\'\' \x05 ">"\n')
            yield terminal.wait(r'< ([^\r\n]*?) *>\r').group(1)
    finally:
        terminal.close()


if __name__ == '__main__':
    for made in complete(*sys.argv[1:3], sys.argv[3:]):
        print(made)
