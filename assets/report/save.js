/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is shown as files: numbers as CSV, pictures as SVG and PNG. All is made in the page. */

/* ---- numbers ---- */

/* A spreadsheet would compute a cell that begins like a formula; an apostrophe keeps it a text. */
const isFormula = text => /^[=@\t\r]/.test(text) || /^[+-]([^.\d]|[.\d]+.*[-+*/^&|=<>!(])/.test(text);
function csvCell(value) {
    if (typeof value !== 'string')
        return value === null || value === undefined || !isFinite(value) ? '' : String(value);
    const text = (isFormula(value) ? "'" : '') + value;
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
/* Columns as in the program's own tables: {name: value} a row; all rows have the names of the first. */
function csv(rows) {
    return [Object.keys(rows[0]), ...rows.map(Object.values)].map(row => row.map(csvCell).join(',') + '\n').join('');
}

/* ---- pictures ---- */

const xml = text => String(text).replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);
const hundredth = value => Math.round(100 * value) / 100;
/* An element as text. */
function tag(name, attributes, inside = '') {
    const list = Object.entries(attributes).filter(([, value]) => value !== undefined)
        .map(([key, value]) => ` ${key}="${xml(typeof value === 'number' ? hundredth(value) : value)}"`);
    return `<${name}${list.join('')}>${inside}</${name}>`;
}
/* A whole file: {text, width, height}. */
function drawing(width, height, label, inside) {
    const margin = 8, size = {width: width + 2 * margin, height: height + 2 * margin};
    const ground = tag('rect', {...size, x: -margin, y: -margin, fill: style('background')});
    return {...size, text: tag('svg', {
        xmlns: 'http://www.w3.org/2000/svg', ...size, viewBox: [-margin, -margin, size.width, size.height].map(hundredth).join(' ')
    }, tag('title', {}, xml(label)) + ground + inside) + '\n'};
}

/* A chart of the page with its colours and fonts, which the page's style sheet gives it, written into the elements. */
function chartDrawing(svg) {
    const names = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linejoin', 'paint-order', 'opacity', 'visibility', 'font-size', 'font-family'];
    const written = from => {
        const look = getComputedStyle(from), attributes = {};
        for (const {name, value} of from.attributes) {
            if (!/^(class|role|style|tabindex|aria-|data-)/.test(name))
                attributes[name] = value;
        }
        names.filter(name => look.getPropertyValue(name) !== 'none' || /^(fill|stroke)$/.test(name)).forEach(name => { attributes[name] = look.getPropertyValue(name); });
        const inside = [...from.childNodes].map(child => child.nodeType === Node.TEXT_NODE ? xml(child.data) : written(child));
        return tag(from.tagName, attributes, inside.join(''));
    };
    return drawing(svg.clientWidth, svg.clientHeight, svg.getAttribute('aria-label'), [...svg.children].map(written).join(''));
}

/* Those parts of a canvas's context that the pictures of the page use; what is drawn becomes elements of SVG. */
class Paper {
    constructor() {
        this.parts = [];
        this.names = 0;
        this.kept = [];
        this.ruler = document.createElement('canvas').getContext('2d');
        this.reset();
    }
    reset() {
        Object.assign(this, {fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, globalAlpha: 1, font: font(13), textAlign: 'left', textBaseline: 'alphabetic', path: ''});
    }
    put(name, attributes, inside) {
        this.parts.push(tag(name, {...attributes, ...(this.globalAlpha < 1 ? {opacity: String(this.globalAlpha)} : {})}, inside));
    }
    /* Draws with another origin. */
    at(x, y, draw) {
        this.reset();
        this.parts.push(`<g transform="translate(${hundredth(x)} ${hundredth(y)})">`);
        draw();
        this.parts.push('</g>');
    }
    name() { return `n${this.names++}`; }
    save() {
        const {fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, textBaseline} = this;
        this.kept.push({groups: 0, look: {fillStyle, strokeStyle, lineWidth, globalAlpha, font, textAlign, textBaseline}});
    }
    restore() {
        const {groups, look} = this.kept.pop();
        this.parts.push('</g>'.repeat(groups));
        Object.assign(this, look);
    }
    clip() {
        const id = this.name();
        this.parts.push(tag('clipPath', {id}, tag('path', {d: this.path})), `<g clip-path="url(#${id})">`);
        this.kept[this.kept.length - 1].groups++;
    }

    step(letter, ...numbers) { this.path += letter + numbers.map(hundredth).join(' '); }
    beginPath() { this.path = ''; }
    moveTo(x, y) { this.step('M', x, y); }
    lineTo(x, y) { this.step('L', x, y); }
    bezierCurveTo(...numbers) { this.step('C', ...numbers); }
    rect(x, y, w, h) { this.step('M', x, y), this.step('h', w), this.step('v', h), this.step('h', -w), this.path += 'z'; }
    arc(x, y, r) { /* a whole circle */
        this.step('M', x - r, y), this.step('a', r, r, 0, 1, 0, 2 * r, 0), this.step('a', r, r, 0, 1, 0, -2 * r, 0);
    }
    /* Two circles around one point, or from a point to a circle. */
    createRadialGradient(x0, y0, r0, x, y, r) {
        const id = this.name(), stops = [], parts = this.parts, from = x0 === x && y0 === y ? r0 / r : 0;
        return {
            addColorStop(place, colour) {
                const [, red, green, blue, alpha] = colour.match(/rgba\((.*),(.*),(.*),(.*)\)/);
                stops.push(tag('stop', {offset: from + (1 - from) * place, 'stop-color': `rgb(${red},${green},${blue})`, 'stop-opacity': alpha}));
            },
            written() {
                parts.push(tag('radialGradient', {id, gradientUnits: 'userSpaceOnUse', cx: x, cy: y, r, fx: x0, fy: y0}, stops.join('')));
                return `url(#${id})`;
            }
        };
    }
    paint(look) { return typeof look === 'string' ? look : look.written(); }
    fill() { this.put('path', {d: this.path, fill: this.paint(this.fillStyle)}); }
    stroke() { this.put('path', {d: this.path, fill: 'none', stroke: this.paint(this.strokeStyle), 'stroke-width': this.lineWidth}); }
    fillRect(x, y, width, height) { this.put('rect', {x, y, width, height, fill: this.paint(this.fillStyle)}); }
    strokeRect(x, y, width, height) { this.put('rect', {x, y, width, height, fill: 'none', stroke: this.paint(this.strokeStyle), 'stroke-width': this.lineWidth}); }
    drawImage(source, x, y, width, height) {
        this.put('image', {x, y, width, height, preserveAspectRatio: 'none', style: 'image-rendering: pixelated', href: source.toDataURL('image/png')});
    }
    measureText(text) {
        this.ruler.font = this.font;
        return this.ruler.measureText(text);
    }
    fillText(text, x, y) {
        const [, size, family] = this.font.match(/^([\d.]+)px (.*)$/), anchor = {left: 'start', center: 'middle', right: 'end'}[this.textAlign];
        this.put('text', {x, y, dy: this.textBaseline === 'middle' ? '.35em' : undefined, 'text-anchor': anchor, 'font-size': size, 'font-family': family, fill: this.fillStyle}, xml(text));
    }
    /* The words of an element, as it shows them; `origin` is the corner of the picture. */
    words(from, origin) {
        const walk = document.createTreeWalker(from, NodeFilter.SHOW_TEXT), range = document.createRange();
        while (walk.nextNode()) {
            const look = getComputedStyle(walk.currentNode.parentElement);
            range.selectNodeContents(walk.currentNode);
            for (const box of [...range.getClientRects()].slice(0, 1)) {
                this.put('text', {x: box.left - origin.left, y: (box.top + box.bottom) / 2 - origin.top, dy: '.35em', 'xml:space': 'preserve', 'font-size': parseFloat(look.fontSize), 'font-family': look.fontFamily,
                                  'font-weight': look.fontWeight, 'font-style': look.fontStyle, fill: look.color}, xml(walk.currentNode.data));
            }
        }
    }
}

/* Points of the screen are four of the file at least, so that pictures can be printed. */
async function png({text, width, height}) {
    const image = new Image(), canvas = document.createElement('canvas'), times = Math.max(2, window.devicePixelRatio || 1);
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    canvas.width = Math.round(width * times), canvas.height = Math.round(height * times);
    canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
    return new Promise(done => canvas.toBlob(done, 'image/png'));
}

/* ---- files ---- */

function keep(words, ending, blob) {
    const link = document.createElement('a');
    link.download = [data.title || 'beadreel', words].join(' ').replace(/[^\p{L}\p{N}.=]+/gu, '-').replace(/^[-.=]+|[-.]+$/g, '') + '.' + ending;
    link.href = URL.createObjectURL(blob);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    say(`Saved as ${link.download}`);
}
/* Buttons that save what is shown: `name()` says what it is, `rows()` are those of the CSV (or null), `picture()` is a drawing. */
function addSaves(parent, what, name, rows, picture) {
    const group = document.createElement('span');
    const ways = {
        CSV: rows && (() => new Blob([csv(rows())], {type: 'text/csv'})),
        SVG: () => new Blob([picture().text], {type: 'image/svg+xml'}),
        PNG: () => png(picture())
    };
    group.className = 'buttons saves';
    group.setAttribute('role', 'group');
    group.setAttribute('aria-label', `Save ${what}`);
    for (const [kind, make] of Object.entries(ways).filter(([, make]) => make)) {
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = kind;
        button.title = `Save ${what} as ${kind}`;
        button.setAttribute('aria-label', button.title);
        button.addEventListener('click', async () => keep(name(), kind.toLowerCase(), await make()));
        group.append(button);
    }
    parent.append(group);
}
