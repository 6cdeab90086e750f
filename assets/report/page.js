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
    table.style.setProperty('--values', head.length - 1);
    const top = table.createTHead().insertRow(), body = table.createTBody();
    head.forEach(text => add(top, 'th', text, 'col'));
    for (const [name, ...values] of rows) {
        const row = body.insertRow();
        add(row, 'th', name, 'row');
        values.forEach(value => add(row, 'td', value));
    }
}

/* ---- a link to what is shown ---- */

/* The part of the address behind `#`, such as t=1.2ms&bead=40. It follows what the reader does, with a pause, as browsers limit how often
 * an address may change; where a page may not change it, as within another page, it stays. */
const link = {
    timer: 0,
    read: () => new URLSearchParams(location.hash.slice(1)),
    write(parts) {
        clearTimeout(link.timer);
        link.timer = setTimeout(() => {
            const text = Object.entries(parts()).map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join('&');
            try {
                history.replaceState(null, '', `#${text}`);
            } catch { /* stays */ }
        }, 300);
    }
};

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
