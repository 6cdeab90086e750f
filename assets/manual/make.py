#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual: chapters of Markdown and the man pages, made into HTML, and the commands in them, for the tests.

    make.py html BUILD TO       everything into the directory TO, with pandoc and mandoc; pictures are made by the chapters' own scenes
    make.py script CHAPTER      a shell script that does what the chapter says, in the current directory

In a chapter, ``` {.LANGUAGE file=NAME} is the text of a file, and ```sh are commands; the line
`INCLUDE PATH` stands for a file of the sources. Comments say what a reader does not see:

    <!-- test: ARGUMENTS -->            the tests give each beadreel and beadsim of the next block these arguments as well: smaller pictures
    <!-- elsewhere: SCRIPT: TEXT -->    the next block is not run here, but in SCRIPT, which has TEXT
    <!-- needs: COMMAND -->            the tests leave the next block out where this command fails, and say so: a program is not
                                       there
    <!-- fails: STATUS -->              the next block ends with this status, and prints the block behind it
    <!-- makes: FILE... -->             these are there now
    <!-- picture: FILE | WORDS | COMMAND --> the picture that COMMAND makes; without a command, FILE of assets
    <!-- live: FILE | WORDS | COMMAND -->    a link to the report that COMMAND makes

With MANUAL=small in the environment, a COMMAND gets the arguments that stand behind one more `|` as well: smaller sweeps and films.
With MANUAL=text none is run, and what they would make is left out.
"""
import html
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ASSETS = os.path.dirname(HERE)
CHAPTERS = ['first-film', 'figure', 'lecture', 'report', 'recipes', 'ask', 'settings', 'sweep', 'cluster', 'publish', 'python', 'elsewhere',
            'library', 'sound', 'help', 'troubleshooting']
PAGES = ['beadreel.1', 'beadsim.1', 'beadreel-scene.5']
COMMENT = re.compile(r'<!-- (\w+): (.*?) -->', re.S)
TOKENS = re.compile(r'^```(?P<info>[^\n]*)\n(?P<text>.*?)^```$|' + COMMENT.pattern, re.S | re.M)


def blocks(text):
    """The comments (kind, words) and fenced blocks ('file' and a name, or a language; the text) of a chapter, in order."""
    for found in TOKENS.finditer(text):
        if found['text'] is None:
            yield found[3], found[4]
            continue
        name = re.search(r'file=([\w.-]+)', found['info'])
        yield ('file', name[1], found['text']) if name else ('block', found['info'].strip(), found['text'])


def read(chapter):
    with open(chapter if os.path.exists(chapter) else os.path.join(HERE, chapter + '.md'), encoding='utf-8') as f:
        text = f.read()
    return re.sub(r'^INCLUDE (.*)\n', lambda m: open(os.path.join(os.path.dirname(ASSETS), m[1]), encoding='utf-8').read(), text, flags=re.M)


def fails(status, commands, message):
    """Commands that end with a status and print a message, word for word."""
    return [f"run_status=0; ( {commands.rstrip()} ) >said 2>&1 || run_status=$?",
            f"[ $run_status -eq {status} ] || {{ echo \"status $run_status, not {status}\"; cat said; exit 1; }}",
            f"printf %s {shlex.quote(message)} | diff - said"]


def script(chapter):
    lines = ['set -euo pipefail', 'extra=()', 'beadreel() { command beadreel "$@" "${extra[@]}"; }',
             'beadsim() { command beadsim "$@" "${extra[@]}"; }']
    extra, skip, failing, needs, needed = '', False, None, None, None  # needed: by the block before
    for kind, first, *rest in blocks(read(chapter)):
        if kind == 'test':
            extra = first
        elif kind == 'needs':
            needs = first
        elif kind == 'elsewhere':
            skip = True
            where, words = first.split(': ', 1)
            lines.append(f"grep -qF -- {shlex.quote(words)} \"$top\"/{where} || {{ echo {shlex.quote(first)}; exit 1; }}")
        elif kind == 'fails':
            failing = [first, None]
        elif kind == 'makes':
            made = f'for f in {first}; do [ -s "$f" ] || {{ echo "no $f"; exit 1; }}; done'
            lines.append(f'if {needed} >/dev/null 2>&1; then {made}; fi' if needed else made)
        elif kind == 'file':
            lines.append(f"cat >{first} <<'END OF FILE'\n{rest[0]}END OF FILE")
        elif kind == 'block' and failing and failing[1] is not None:
            lines += fails(*failing, rest[0])
            failing = None
        elif kind == 'block' and first == 'sh':
            if failing:
                failing[1] = rest[0]
            elif not skip:
                absent = f'else\necho {shlex.quote(needs or "")} >>missing\nfi'
                lines += [f'extra=({extra})', f'if {needs} >/dev/null 2>&1; then\n{rest[0].rstrip()}\n{absent}' if needs else rest[0].rstrip()]
            extra, skip, needs, needed = '', False, None, needs
    return '\n'.join(lines) + '\n'


class Manual:
    def __init__(self, build, to):
        self.to = to
        self.environment = dict(os.environ, PATH=os.path.abspath(build) + ':' + os.environ['PATH'], BEADREEL_ASSETS=ASSETS)
        self.version = subprocess.run(['beadreel', '--version'], env=self.environment, capture_output=True, text=True,
                                      check=True).stdout.split()[1]

    def run(self, work, command, smaller=''):
        command += ' ' + smaller if os.environ.get('MANUAL') == 'small' else ''
        subprocess.run(command, shell=True, cwd=work, env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def picture(self, work, words):
        name, alt, *command = re.split(r' \| *', words)
        if command and os.environ.get('MANUAL') == 'text':
            return ''
        if command:
            self.run(work, *command)
        shutil.copy(os.path.join(work if command else ASSETS, name), self.to)
        return f'<figure><img src="{os.path.basename(name)}" alt="{html.escape(alt)}"></figure>'

    def live(self, work, words):
        name, label, *command = re.split(r' \| *', words)
        if os.environ.get('MANUAL') == 'text':
            return label
        self.run(work, *command)
        os.makedirs(os.path.join(self.to, 'live'), exist_ok=True)
        shutil.copy(os.path.join(work, name), os.path.join(self.to, 'live'))
        return f'[{label}](live/{name})'

    def body(self, chapter):
        """The Markdown of a chapter with its pictures made; its other comments gone."""
        text = read(chapter)
        with tempfile.TemporaryDirectory() as work:
            for kind, first, *rest in blocks(text):
                if kind == 'file':
                    with open(os.path.join(work, first), 'w', encoding='utf-8') as f:
                        f.write(rest[0])
            made = {'picture': self.picture, 'live': self.live}
            return COMMENT.sub(lambda c: made[c[1]](work, c[2].replace('\n', ' ')) if c[1] in made else '', text)

    def navigation(self, here):
        def items(entries):
            return ''.join(f'<li><a href="{name}.html"{" aria-current=page" if name == here else ""}>{html.escape(title)}</a></li>'
                           for name, title in entries)
        chapters = [('index', 'Contents')] + [(c, title_of(read(c))) for c in CHAPTERS]
        pages = [(p, re.sub(r'(.*)\.(\d)', r'\1(\2)', p)) for p in PAGES]
        return f'<ul>{items(chapters)}</ul><p>Reference</p><ul>{items(pages)}</ul>'

    def page(self, name, markdown, *options):
        made = subprocess.run(['pandoc', '--from=markdown-smart', '--to=html5', '--no-highlight', '--section-divs', '--toc', '--toc-depth=2',
                               f'--template={HERE}/page.html', f'--variable=nav:{self.navigation(name)}', f'--variable=version:{self.version}',
                               *options], input=markdown, capture_output=True, text=True, check=True).stdout
        made = re.sub(r'href="([a-z-]+)\.md"', r'href="\1.html"', made)
        made = re.sub(r'href="\.\./man/([a-z-]+\.\d)"', r'href="\1.html"', made)
        with open(os.path.join(self.to, name + '.html'), 'w', encoding='utf-8') as f:
            f.write(made)

    def man_page(self, name):
        made = subprocess.run(['mandoc', '-T', 'html', '-O', 'fragment,man=%N.%S.html', os.path.join(ASSETS, 'man', name)],
                              capture_output=True, text=True, check=True).stdout
        made = re.sub(r'<pre>.*?</pre>', lambda m: m[0].replace('<br/>\n', ''), made, flags=re.S)  # lines end by themselves there
        heads = re.findall(r'<h([12]) class="S[hs]" id="([^"]*)"><a [^>]*>(.*?)</a>', made, re.S)
        items = ''.join(f'<li class="level{level}"><a href="#{name}">{words}</a></li>' for level, name, words in heads)
        made = made.replace('<div class="manual-text">', f'<nav class="contents" aria-label="Contents"><ul>{items}</ul></nav>\n<div class="manual-text">', 1)
        title = re.sub(r'(.*)\.(\d)', r'\1(\2)', name)
        self.page(name, f'```{{=html}}\n{made}\n```\n', f'--metadata=title:{title}', '--variable=man:yes')

    def make(self):
        os.makedirs(self.to, exist_ok=True)
        shutil.copy(os.path.join(HERE, 'style.css'), self.to)
        for chapter in CHAPTERS:
            self.page(chapter, self.body(chapter))
        for page in PAGES:
            self.man_page(page)
        contents = ''.join(f'- [{title_of(read(c))}]({c}.md): {summary_of(read(c))}\n' for c in CHAPTERS)
        self.page('index', self.body('index').replace('CONTENTS', contents))


def title_of(text):
    return re.search(r'^title: (.*)$', text, re.M)[1]


def summary_of(text):
    return re.search(r'^summary: (.*)$', text, re.M)[1]


if __name__ == '__main__':
    if sys.argv[1] == 'html':
        Manual(*sys.argv[2:4]).make()
    else:
        sys.stdout.write(script(sys.argv[2]))
