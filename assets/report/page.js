/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all reports have: tables, the scene with its button, who made them. */

const say = text => { element('said').textContent = text; };

function buildTable(table, head, rows) {
    const add = (parent, kind, text, scope) => {
        const cell = document.createElement(kind);
        cell.textContent = text;
        if (scope)
            cell.scope = scope;
        parent.append(cell);
    };
    table.textContent = '';
    const top = table.createTHead().insertRow(), body = table.createTBody();
    head.forEach(text => add(top, 'th', text, 'col'));
    for (const [name, ...values] of rows) {
        const row = body.insertRow();
        add(row, 'th', name, 'row');
        values.forEach(value => add(row, 'td', value));
    }
}

/* ---- the scene ---- */

function buildCopy() {
    const button = element('copy'), text = element('scene-text').textContent;
    button.addEventListener('click', async () => {
        try {
            await navigator.clipboard.writeText(text);
        } catch { /* pages from files may not, but what is selected can be copied */
            const range = document.createRange();
            range.selectNodeContents(element('scene-text'));
            getSelection().removeAllRanges();
            getSelection().addRange(range);
            document.execCommand('copy');
        }
        button.textContent = 'Copied';
        say('The scene is copied');
        setTimeout(() => { button.textContent = 'Copy'; }, 2000);
    });
}

element('made').textContent = `Made by ${data.program}. Everything is in this file; it asks nothing of the network.`;
buildCopy();
