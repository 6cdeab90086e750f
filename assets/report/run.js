/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run: the stage with all chains, playing, zooming and choosing with pointer and keys, and the parts of the page below. */

const chains = data.chains.map((c, i) => new Chain(c, i));
const canvases = [];
let oneChart = null, frame = 0, before = 0;

/* Seconds that the whole run takes at speed 1. */
const filmSeconds = 10;
const chainName = chain => chain.name || 'the chain';

/* ---- the stage ---- */

function buildStage() {
    for (const chain of chains) {
        const figure = document.createElement('figure'), caption = document.createElement('figcaption');
        const canvas = document.createElement('canvas');
        figure.className = 'chain';
        addWords(caption, chain);
        canvas.tabIndex = 0;
        canvas.setAttribute('role', 'application');
        canvas.setAttribute('aria-label', `${chain.name || 'Chain'}: ${chain.displacement ? 'beads, ' : ''}${data.field.title} along the chain, and over chain and time. ${chain.tale} Arrows choose a ${chain.axis.title} and step in time.`);
        figure.append(caption, canvas);
        element('chains').append(figure);
        canvases.push(canvas);
        listen(canvas, chain);
    }
}
function addWords(caption, chain) {
    const add = (kind, text) => {
        const made = document.createElement(kind);
        made.textContent = text;
        caption.append(made);
        return made;
    };
    if (chain.name)
        add('strong', chain.name);
    if (chain.magnetism !== undefined) {
        const sign = document.createElement('i');
        sign.textContent = 'M';
        add('em', '').append(sign, ` = ${figures(chain.magnetism, 3)}`);
    }
    add('span', chain.label || (chain.name ? '' : `${chain.total} ${chain.displacement ? 'beads' : 'points'}`));
}

/* Chains side by side where each has room, and all of them in the window together with the controls. */
function layOut() {
    const narrow = matchMedia('(max-width: 760px)').matches, count = chains.length;
    const columns = narrow || count === 1 ? 1 : innerWidth > 1100 && count > 2 ? Math.min(count, 4) : 2;
    /* The first column has the labels; all pictures are alike in size. */
    const labels = 40, grid = element('chains'), barHeight = narrow ? 28 : 0;
    const captions = canvases.map(canvas => canvas.previousSibling);
    showBar(narrow, barHeight); /* its width counts */
    const plot = Math.floor((grid.clientWidth - labels - 14 * (columns - 1)) / columns);
    grid.style.gridTemplateColumns = Array.from({length: columns}, (_, i) => `${plot + (i ? 0 : labels)}px`).join(' ');
    captions.forEach((caption, i) => { caption.style.paddingLeft = narrow ? '0' : i % columns ? '6px' : `${labels + 6}px`; });
    const rows = Math.ceil(count / columns), top = element('stage').getBoundingClientRect().top + scrollY;
    const caption = Math.max(...captions.map(c => c.offsetHeight));
    const free = innerHeight - top - element('controls').offsetHeight - 12 - barHeight - (narrow ? 4 : 26);
    const height = Math.round(clamp(free / rows - caption - 10, narrow ? 240 : 300, narrow ? 640 : 1100));
    chains.forEach((chain, i) => Object.assign(chain, {width: plot + (i % columns ? 0 : labels), height, labels: i % columns === 0}));
    showBar(narrow, narrow ? barHeight : rows * (height + caption) + (rows - 1) * 10);
    arrange();
}
function arrange() {
    const below = Math.max(...chains.map(c => c.arrange(c.width, c.height, c.labels)));
    chains.forEach(c => c.arrangeBelow(below));
}
const othersOf = chain => chains.filter(c => c !== chain);
function draw() {
    canvases.forEach((canvas, i) => chains[i].draw(prepare(canvas, chains[i].width, chains[i].height), othersOf(chains[i])));
    element('clock').textContent = clockText(timeOf(state.sample));
    element('time').value = Math.round(state.sample);
    if (!state.playing)
        element('time').setAttribute('aria-valuetext', clockText(timeOf(state.sample)));
    if (oneChart)
        oneChart.now(timeOf(state.sample));
}
function redraw() {
    if (!frame)
        frame = requestAnimationFrame(now => { frame = 0; tick(now); });
}

/* ---- playing ---- */

function tick(now) {
    if (state.playing) {
        const rate = (samples - 1) / filmSeconds * Number(element('speed').value) / 1000;
        state.sample += Math.min(100, now - before) * rate;
        before = now;
        if (state.sample >= samples - 1) {
            state.sample = samples - 1;
            play(false);
        }
    }
    draw();
    if (state.playing)
        redraw();
}
function play(on) {
    state.playing = on;
    before = performance.now();
    if (on && state.sample >= samples - 1)
        state.sample = 0;
    element('play-shape').setAttribute('d', on ? 'M4 3h4v14H4zM12 3h4v14h-4z' : 'M5 2.5v15l12-7.5z');
    element('play-name').textContent = on ? 'Pause' : 'Play';
    redraw();
    remember();
}
function seek(sample) {
    state.sample = clamp(sample, 0, samples - 1);
    redraw();
    remember();
}
function buildControls() {
    const time = element('time'), speed = element('speed');
    time.max = samples - 1;
    time.addEventListener('input', () => seek(Number(time.value)));
    for (const rate of [0.1, 0.25, 0.5, 1, 2]) {
        const passes = (timeOf(samples - 1) - timeOf(0)) * rate / filmSeconds / timeUnit[0];
        const words = innerWidth < 500 ? '' : ` (1 s = ${figures(passes, 2)}${timeName ? ' ' + timeName : ''})`;
        speed.add(new Option(`${rate}×${words}`, rate));
    }
    speed.value = '1';
    element('play').addEventListener('click', () => play(!state.playing));
    element('closer').addEventListener('click', () => zoomBy(0.5));
    element('wider').addEventListener('click', () => zoomBy(2));
    element('whole').addEventListener('click', () => setZoom(null));
    element('overlay').addEventListener('change', event => { state.overlay = event.target.checked; redraw(); });
    element('overlay-label').hidden = chains.length < 2;
    addEventListener('keydown', keys);
}
/* Keys of the page, but where something is typed. */
function keys(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA|BUTTON|SUMMARY)$/.test(event.target.tagName) && event.target.type !== 'range')
        return;
    const actions = {
        ' ': () => play(!state.playing), ',': () => seek(Math.round(state.sample) - 1), '.': () => seek(Math.round(state.sample) + 1),
        '+': () => zoomBy(0.5), '=': () => zoomBy(0.5), '-': () => zoomBy(2), '0': () => setZoom(null)
    };
    if (!actions[event.key])
        return;
    event.preventDefault();
    actions[event.key]();
}

/* ---- zooming ---- */

function setZoom(zoom) {
    const most = Math.max(...chains.map(c => c.values)) - 0.5, whole = {places: [-0.5, most], samples: [0, samples - 1]};
    if (zoom) {
        const fit = (span, [low, high], least) => {
            const size = clamp(span[1] - span[0], least, high - low), from = clamp(0.5 * (span[0] + span[1] - size), low, high - size);
            return [from, from + size];
        };
        zoom = {places: fit(zoom.places, whole.places, 4), samples: fit(zoom.samples, whole.samples, 8)};
        const all = zoom.places[1] - zoom.places[0] > most + 0.49 && zoom.samples[1] - zoom.samples[0] > samples - 1.01;
        zoom = all ? null : zoom;
    }
    state.zoom = zoom;
    arrange();
    say(zoom ? `Zoomed to ${chains[0].axis.title} ${figures(Math.ceil(zoom.places[0]), 4)} to ${Math.floor(zoom.places[1])}, ${clockText(timeOf(zoom.samples[0]))} to ${clockText(timeOf(zoom.samples[1]))}` : 'Everything is shown');
    redraw();
}
/* About a point, else the chosen bead and the time shown. */
function zoomBy(factor, centre) {
    const places = state.zoom ? state.zoom.places : [-0.5, Math.max(...chains.map(c => c.values)) - 0.5];
    const times = state.zoom ? state.zoom.samples : [0, samples - 1];
    const front = Math.max(...chains.map(c => c.front[Math.round(state.sample)]));
    const about = centre || {place: state.bead === null ? front : state.bead, sample: state.sample};
    const around = (span, at) => span.map(v => at + (v - at) * factor);
    setZoom({places: around(places, about.place), samples: around(times, about.sample === null ? state.sample : about.sample)});
}

/* ---- the pointer ---- */

const pointers = new Map();
let pinched = false; /* the fingers that leave choose nothing */
function listen(canvas, chain) {
    const local = event => {
        const box = canvas.getBoundingClientRect();
        return {x: event.clientX - box.left, y: event.clientY - box.top};
    };
    canvas.addEventListener('pointerdown', event => {
        const p = local(event), i = chain.image;
        pointers.set(event.pointerId, p);
        if (event.pointerType === 'mouse' && event.button === 0 && p.y >= i.y && p.y <= i.y + i.h)
            state.box = {chain, x0: p.x, y0: p.y, x1: p.x, y1: p.y};
    });
    canvas.addEventListener('pointermove', event => {
        const p = local(event), old = pointers.get(event.pointerId);
        if (old && pointers.size === 2)
            pinch(chain, event.pointerId, p);
        if (state.box && state.box.chain === chain)
            state.box.x1 = p.x, state.box.y1 = p.y;
        hover(chain, event, p);
        redraw();
    });
    canvas.addEventListener('pointerup', event => {
        const p = local(event), old = pointers.get(event.pointerId), box = state.box;
        pointers.delete(event.pointerId);
        state.box = null;
        if (box && Math.hypot(box.x1 - box.x0, box.y1 - box.y0) > 8)
            zoomToBox(chain, box);
        else if (old && !pinched && Math.hypot(p.x - old.x, p.y - old.y) < 8)
            choose(chain.at(p.x, p.y));
        pinched = pinched && pointers.size > 0;
        redraw();
    });
    for (const end of ['pointercancel', 'pointerleave'])
        canvas.addEventListener(end, event => { pointers.delete(event.pointerId); state.hover = state.box = null; hideTip(); redraw(); });
    canvas.addEventListener('dblclick', () => setZoom(null));
    canvas.addEventListener('wheel', event => {
        if (!event.ctrlKey && !event.metaKey)
            return;
        const p = local(event);
        event.preventDefault();
        zoomBy(Math.exp(event.deltaY * 0.003), chain.at(p.x, p.y));
    }, {passive: false});
    canvas.addEventListener('keydown', event => arrows(chain, event));
}
function zoomToBox(chain, box) {
    const a = chain.at(Math.min(box.x0, box.x1), Math.min(box.y0, box.y1)), i = chain.image;
    const b = chain.at(Math.min(i.x + i.w, Math.max(box.x0, box.x1)), Math.min(i.y + i.h, Math.max(box.y0, box.y1)));
    if (a && b)
        setZoom({places: [a.place - 0.5, b.place + 0.5], samples: [a.sample, b.sample]});
}
function pinch(chain, id, p) {
    const other = [...pointers].find(([key]) => key !== id)[1], old = pointers.get(id);
    const was = Math.hypot(old.x - other.x, old.y - other.y), is = Math.hypot(p.x - other.x, p.y - other.y);
    pointers.set(id, p);
    pinched = true;
    if (was > 10 && is > 10)
        zoomBy(was / is, chain.at(0.5 * (p.x + other.x), 0.5 * (p.y + other.y)));
}
function hover(chain, event, p) {
    const found = chain.at(p.x, p.y);
    state.hover = found;
    if (!found) {
        hideTip();
        return;
    }
    const sample = found.sample === null ? state.sample : found.sample;
    const bead = chain.material && !data.field.contacts ? chain.materialName(found.place) : '';
    const lines = [['', `${chain.axis.title} ${figures(chain.number(found.place), 6)}${bead ? ` (${bead})` : ''}`, clockText(timeOf(sample))]];
    for (const c of chains.filter(each => found.place < each.values)) {
        lines.push([chains.length > 1 ? style(c.colourName().slice(2)) : '', c.name || data.field.name, quantity(c.value(found.place, sample), data.field.unit)]);
        if (c === chain && c.displacement && found.place < c.beads)
            lines.push(['', 'displacement', quantity(between(c.displacement, c.beads, found.place, sample), 'm', 3)]);
    }
    showTip(event, lines);
}
function arrows(chain, event) {
    const step = event.shiftKey ? 10 : 1, moves = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
    const move = moves[event.key];
    if (!move)
        return;
    event.preventDefault();
    const from = state.bead === null ? Math.round(chain.front[Math.round(state.sample)]) : state.bead;
    if (move[1])
        state.sample = clamp(Math.round(state.sample) + move[1] * Math.max(1, Math.round(samples / 200)), 0, samples - 1);
    choose({place: clamp(from + move[0], 0, chain.values - 1), sample: null});
    say(`${chain.axis.title} ${figures(chain.number(state.bead), 6)}, ${clockText(timeOf(state.sample))}: ${quantity(chain.value(state.bead, state.sample), data.field.unit)}`);
}

/* ---- one bead ---- */

function choose(found) {
    if (!found)
        return;
    state.bead = found.place;
    if (found.sample !== null)
        seek(found.sample);
    showOne();
    redraw();
    remember();
}
/* The field at the chosen bead against time, of every chain that has it. */
function showOne() {
    const {place, number, words} = shownBead();
    const times = Array.from({length: samples}, (_, s) => timeOf(s)), unit = data.field.unit;
    const series = chains.filter(c => place < c.values).map(c => ({
        name: chains.length > 1 ? c.name : '', colour: c.colourName(), x: times, y: times.map((_, s) => c.value(place, s)), chain: c
    }));
    const all = series.flatMap(s => s.y), high = Math.max(...series.map(s => s.y.reduce((a, b) => Math.max(a, b), 0)), 1e-300);
    const low = all.reduce((a, b) => Math.min(a, b), 0), [factor, sign] = prefix(Math.max(high, -low), unit);
    element('bead').value = number.replace('−', '-');
    oneChart = drawChart(element('one-chart'), {
        x: {title: timeName ? `time (${timeName})` : 'time', low: times[0], high: times[samples - 1], factor: timeUnit[0]},
        y: {title: `${data.field.title}${unit ? ` (${sign}${unit})` : ''}, ${words}`, low: low * 1.06, high: high * 1.08, factor},
        series, label: `${data.field.title} of ${words} against time. ` + series.map(s => {
            const largest = s.y.reduce((best, y, i) => y > s.y[best] ? i : best, 0);
            return `${chainName(s.chain)}: largest ${quantity(s.y[largest], unit)} at ${clockText(times[largest])}`;
        }).join('; '),
        pick: x => seek((x - data.time.start) / data.time.every),
        tip: (_, i) => [['', words, clockText(times[i])], ...series.map(s => [`var(${s.colour})`, s.name || data.field.name, quantity(s.y[i], unit)])]
    });
    oneChart.now(timeOf(state.sample));
}
function buildOne() {
    const input = element('bead'), chain = chains[0], most = Math.max(...chains.map(c => c.values));
    const title = data.field.title; /* a symbol stays as it is */
    element('one-title').textContent = `${title.length > 1 ? title[0].toUpperCase() + title.slice(1) : title} against time`;
    element('one-what').textContent = chain.axis.title;
    input.min = chain.number(0), input.max = chain.number(most - 1), input.step = chain.axis.spacing;
    input.addEventListener('change', () => {
        const place = Math.round((Number(input.value) - chain.axis.first) / chain.axis.spacing);
        choose({place: clamp(place, 0, most - 1), sample: null});
    });
    addSaves(element('one-title').parentElement, 'these curves', () => shownBead().words, oneRows, () => chartDrawing(element('one-chart')));
}
/* The bead that the chart shows: the chosen one, else one half way. */
function shownBead() {
    const place = state.bead === null ? Math.round(Math.min(...chains.map(c => c.values)) / 2) : state.bead;
    const number = figures(chains[0].number(place), 6);
    return {place, number, words: `${chains[0].axis.title} ${number}`};
}

/* ---- files ---- */

const fieldColumn = () => data.field.name + (data.field.unit ? `_${data.field.unit}` : '');
const timeColumn = () => data.time.unit ? `time_${data.time.unit}` : 'time';
const chainColumn = chain => chains.length > 1 ? {chain: chain.name} : {};
/* As tables of profiles have them. */
const fieldRow = (chain, place, sample) =>
    ({...chainColumn(chain), [timeColumn()]: timeOf(sample), [chain.axis.title]: chain.number(place), [fieldColumn()]: chain.value(place, sample)});
function oneRows() {
    const {place} = shownBead();
    return chains.filter(c => place < c.values).flatMap(c => Array.from({length: samples}, (_, s) => fieldRow(c, place, s)));
}
function profileRows() {
    return chains.flatMap(c => Array.from({length: c.values}, (_, place) => fieldRow(c, place, state.sample)));
}
/* The stage as it is shown, with its colour bar. */
function stageDrawing() {
    const stage = element('stage').getBoundingClientRect(), paper = new Paper(), corner = canvas => {
        const box = canvas.getBoundingClientRect();
        return [box.left - stage.left, box.top - stage.top];
    };
    chains.forEach((chain, i) => {
        paper.at(0, 0, () => paper.words(canvases[i].previousSibling, stage));
        paper.at(...corner(canvases[i]), () => chain.draw(paper, othersOf(chain)));
    });
    paper.at(...corner(element('bar')), () => drawBar(paper, !bar.narrow, bar.width, bar.height));
    return drawing(stage.width, stage.height, `${data.title} ${clockText(timeOf(state.sample))}`, paper.parts.join(''));
}

/* ---- the link ---- */

const remember = () => link.write(() =>
    ({t: writtenTime(timeOf(state.sample)), ...(state.bead === null ? {} : {[chains[0].axis.title]: shownBead().number.replace('−', '-')})}));
/* Shows the moment and the bead of the address, where it has them. */
function followLink() {
    const asked = link.read(), axis = chains[0].axis, time = readTime(asked.get('t')), number = parseFloat(asked.get(axis.title));
    if (time !== null)
        state.sample = clamp((time - data.time.start) / data.time.every, 0, samples - 1);
    if (isFinite(number))
        state.bead = clamp(Math.round((number - axis.first) / axis.spacing), 0, Math.max(...chains.map(c => c.values)) - 1);
}
