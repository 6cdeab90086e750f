/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sweep: force against magnetism, and the space-time images of its configurations. */

const state = {panel: 0, place: 0, image: null};
let chart = null;

/* ---- images ---- */

/* Rows of an image: how many places the wave has reached, then their colours; the others have the colour at rest. */
function pixels(image) {
    const from = bytes(image.data), map = colourMap(), out = new ImageData(image.places, data.times), rest = 3 * colourIndex(data.range.rest);
    for (let t = 0, p = 0; t < data.times; t++) {
        const reached = from[p] | from[p + 1] << 8;
        p += 2;
        for (let i = 0; i < image.places; i++) {
            const c = i < reached ? 3 * from[p + i] : rest, to = 4 * (t * image.places + i);
            out.data[to] = map[c], out.data[to + 1] = map[c + 1], out.data[to + 2] = map[c + 2], out.data[to + 3] = 255;
        }
        p += reached;
    }
    return out;
}
/* With axes: places along, time down. */
function drawImage(context, image, width, height) {
    const box = {x: 46, y: 20, w: width - 46 - 6, h: height - 20 - 24};
    const source = document.createElement('canvas');
    const [factor, sign] = prefix(data.end, 's'), title = data.field.contacts ? 'contact' : 'bead';
    source.width = image.places, source.height = data.times;
    source.getContext('2d').putImageData(pixels(image), 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(source, box.x, box.y, box.w, box.h);
    context.fillStyle = style('ink');
    context.font = font(13);
    context.textBaseline = 'middle';
    context.textAlign = 'right';
    const down = roundTicks(0, data.end / factor, Math.max(2, box.h / 45)), along = roundTicks(0, image.values - 1, box.w / 62);
    tickLabels(down).forEach((text, k) => context.fillText(text, box.x - 8, clamp(box.y + box.h * down[k] * factor / data.end, box.y + 6, box.y + box.h - 5)));
    context.textAlign = 'center';
    tickLabels(along).forEach((text, k) => context.fillText(text, clamp(box.x + box.w * (along[k] + 0.5) / image.values, box.x + 4, box.x + box.w - 8), box.y + box.h + 13));
    context.textAlign = 'left';
    context.fillText(title, 2, box.y + box.h + 13);
    context.fillText(`time (${sign}s)`, 2, 8);
}

/* ---- what is chosen ---- */

const shownSize = {width: 0, height: 0}; /* of an image */
const panelNow = () => data.panels[state.panel];
const placeNow = () => panelNow().places[state.place];
const cleanImage = () => panelNow().images.find(i => i.index === null);
/* Configurations that have images, by rising magnetism. */
const shownImages = () => panelNow().images.filter(i => i.index !== null).sort((a, b) => a.magnetism - b.magnetism || a.index - b.index);
const forceOf = index => placeNow().values[placeNow().indices.indexOf(index)];

function heading(target, image, words) {
    const sign = document.createElement('em'), letter = document.createElement('i');
    target.textContent = '';
    letter.textContent = 'M';
    sign.append(letter, ` = ${figures(image.magnetism, 3)}`);
    target.append(sign, words);
}
function show(image) {
    const force = forceOf(image.index), clean = cleanImage();
    state.image = image;
    heading(element('shown-title'), image, ` · no. ${image.index} · F = ${figures(force, 3)}`);
    heading(element('clean-title'), clean, ` · all upright · F = 1 (${quantity(placeNow().clean, 'N')})`);
    const free = element('force-chart').clientHeight - 66, narrow = matchMedia('(max-width: 760px)').matches;
    const height = narrow ? 240 : Math.max(170, Math.round(free / 2));
    Object.assign(shownSize, {height, width: element('shown').clientWidth});
    for (const [name, shown] of [['shown-image', image], ['clean-image', clean]])
        drawImage(prepare(element(name), shownSize.width, height), shown, shownSize.width, height);
    element('shown-image').setAttribute('aria-label', `${data.field.title} over beads and time, configuration ${image.index}, magnetism ${figures(image.magnetism, 3)}, force ${figures(force, 3)} of the clean chain's`);
    element('clean-image').setAttribute('aria-label', `${data.field.title} over beads and time of the chain with all cells upright`);
    const spins = element('spins');
    spins.textContent = '';
    spins.append(...[...image.spins].map(s => Object.assign(document.createElement('i'), {className: s === '1' ? 'up' : ''})));
    spins.setAttribute('aria-label', `Random cells, left to right: ${[...image.spins].filter(s => s === '1').length} of ${image.spins.length} upright`);
    chart.mark(image.magnetism, force);
}
function step(by) {
    const all = shownImages(), at = all.indexOf(state.image);
    show(all[clamp(at + by, 0, all.length - 1)]);
    remember();
    say(element('shown-title').textContent);
}
/* The nearest configuration that has an image. */
function choose(index) {
    const near = shownImages().reduce((a, b) => Math.abs(b.index - index) < Math.abs(a.index - index) ? b : a);
    show(near);
    remember();
}

/* ---- files and the link ---- */

/* As tables of configurations have them. */
function forceRows() {
    const {rows, indices, values, clean} = placeNow(), magnetism = rows.flatMap(([m, count]) => Array(count).fill(m));
    return indices.map((index, i) => ({configuration: index, magnetism: magnetism[i], peak_force_N: values[i] * clean}));
}
function imagesDrawing() {
    const corner = element('shown').getBoundingClientRect(), {width, height} = shownSize, paper = new Paper();
    for (const [name, title, image] of [['shown-image', 'shown-title', state.image], ['clean-image', 'clean-title', cleanImage()]]) {
        const box = element(name).getBoundingClientRect();
        paper.at(0, 0, () => paper.words(element(title), corner));
        paper.at(box.left - corner.left, box.top - corner.top, () => drawImage(paper, image, width, height));
    }
    return drawing(corner.width, corner.height, element('shown-title').textContent, paper.parts.join(''));
}
function remember() {
    link.write(() => ({configuration: state.image.index, ...(data.panels.length > 1 ? {sweep: state.panel} : {}), ...(panelNow().places.length > 1 ? {place: state.place} : {})}));
}
/* Shows what the address asks for, where it is there. */
function followLink() {
    const asked = link.read(), whole = key => /^\d+$/.test(asked.get(key) || '') ? Number(asked.get(key)) : -1;
    if (data.panels[whole('sweep')])
        state.panel = whole('sweep'), state.place = 0;
    if (panelNow().places[whole('place')])
        state.place = whole('place');
    fillPicks();
    enter(shownImages().find(i => i.index === whole('configuration')));
}

/* ---- the chart ---- */

/* As plots write it. */
const critical = threshold => threshold[2].toFixed(3) + (threshold[3] ? ` ± ${threshold[3].toFixed(3)}` : '');

function drawForces() {
    const place = placeNow(), rows = place.rows.map(([magnetism, count, mean, error, median]) => ({magnetism, count, mean, error, median}));
    const x = rows.flatMap(r => Array(r.count).fill(r.magnetism)), largest = place.values.reduce((a, b) => Math.max(a, b), 1);
    const lone = {points: 2.6, line: false, faint: 0.5};
    chart = drawChart(element('force-chart'), {
        x: {title: 'magnetism M', low: Math.min(0, ...x) - 0.02, high: 1.02, factor: 1},
        y: {title: 'peak force F / F(M = 1)', low: 0, high: 1.05 * largest, factor: 1},
        series: [
            {name: 'each configuration', colour: '--curve0', x, y: place.values, id: place.indices, ...lone},
            {name: 'mean', colour: '--curve1', x: rows.map(r => r.magnetism), y: rows.map(r => r.mean), error: rows.map(r => r.error), mute: true},
            {name: 'median', colour: '--curve2', x: rows.map(r => r.magnetism), y: rows.map(r => r.median), dashed: true, mute: true}
        ],
        rulers: place.threshold ? [
            {y: place.threshold[0], band: place.threshold[1], words: `plateau ${figures(place.threshold[0], 3)}`},
            ...(place.threshold[2] === null ? [] : [{x: place.threshold[2], band: place.threshold[3], words: `M_c = ${critical(place.threshold)}`}])
        ] : [],
        plane: true,
        label: `Peak force against magnetism of ${place.values.length} configurations, in units of the clean chain's ${quantity(place.clean, 'N')}. Arrows go from one configuration to the next.`,
        pick: (_, found) => choose(place.indices[found.index]),
        tip: (series, i) => [['', `M = ${figures(x[i], 3)}`, `no. ${place.indices[i]}`], ['', 'F', `${figures(place.values[i], 4)} (${quantity(place.values[i] * place.clean, 'N', 4)})`]]
    });
    element('force-note').textContent = `Forces in units of that of the clean chain, ${quantity(place.clean, 'N', 5)}. Bars are standard errors of means.`;
    showRows(rows, place);
}
function showRows(rows, place) {
    const t = place.threshold;
    element('threshold').textContent = t ? `Plateau ${uncertain(t[0], t[1], '').trim()}${t[2] === null ? '' : `, threshold in M ${critical(t)}`}.` : '';
    buildTable(element('numbers-table'), ['M', 'configurations', 'mean ± standard error', 'median'],
               rows.map(r => [figures(r.magnetism, 4), String(r.count), uncertain(r.mean, r.error, '').trim(), figures(r.median, 4)]));
}

function drawAll() {
    const narrow = matchMedia('(max-width: 760px)').matches;
    drawForces();
    show(state.image);
    showBar(narrow, narrow ? 28 : element('plot').clientHeight - 10);
}
/* Another sweep or place begins in the middle of its magnetisms. */
function enter(image) {
    state.image = image || shownImages().reduce((a, b) => Math.abs(b.magnetism - 0.5) < Math.abs(a.magnetism - 0.5) ? b : a);
    drawAll();
}
function fillPicks() {
    const place = element('place');
    element('panel').value = state.panel;
    place.textContent = '';
    panelNow().places.forEach((p, i) => place.add(new Option(p.name, i)));
    place.value = state.place;
    element('place-label').hidden = panelNow().places.length < 2;
}
function buildPicks() {
    const panel = element('panel'), place = element('place');
    data.panels.forEach((p, i) => panel.add(new Option(p.name || `sweep ${i + 1}`, i)));
    element('panel-label').hidden = data.panels.length < 2;
    panel.addEventListener('change', () => { state.panel = Number(panel.value), state.place = 0; fillPicks(); enter(); remember(); });
    place.addEventListener('change', () => { state.place = Number(place.value); drawAll(); remember(); });
}

const all = data.panels.reduce((sum, p) => sum + p.configurations, 0);
element('facts').textContent = `${all} configurations of ${panelNow().cells} random cells`;
buildPicks();
followLink();
addEventListener('hashchange', followLink);
addSaves(element('plot-title').parentElement, 'these forces', () => 'forces', forceRows, () => chartDrawing(element('force-chart')));
addSaves(element('saves'), 'these images', () => `configuration ${state.image.index}`, null, imagesDrawing);
element('previous').addEventListener('click', () => step(-1));
element('next').addEventListener('click', () => step(1));
addEventListener('keydown', event => {
    const by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (by && !/^(INPUT|SELECT)$/.test(event.target.tagName) && !event.ctrlKey && !event.altKey && !event.metaKey) {
        event.preventDefault();
        step(by);
    }
});
let wide = innerWidth;
addEventListener('resize', () => {
    if (innerWidth !== wide)
        wide = innerWidth, drawAll();
});
dark.addEventListener('change', drawAll);
/* For tests and consoles. */
window.report = {data, state, choose, shownImages, pixels};
