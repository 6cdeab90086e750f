/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks and numbers of a run; and everything set going. */

/* ---- peaks ---- */

const peakText = (chain, k) => uncertain(chain.peaks.force[k], chain.peaks.uncertainty[k], 'N');
const peakTime = (chain, k) => chain.peaks.time_uncertainty[k] > 0 ? uncertain(chain.peaks.time[k], chain.peaks.time_uncertainty[k], 's') : quantity(chain.peaks.time[k], 's');
function showPeaks() {
    const with_ = chains.filter(c => c.peaks);
    if (with_.length === 0)
        return;
    const high = Math.max(...with_.flatMap(c => c.peaks.force.filter(f => f !== null))), [factor, sign] = prefix(high, 'N');
    const count = Math.max(...with_.map(c => c.peaks.force.length));
    element('peaks').hidden = false;
    drawChart(element('peaks-chart'), {
        x: {title: 'contact', low: -1, high: count, factor: 1},
        y: {title: `peak force (${sign}N)`, low: 0, high: 1.06 * high, factor},
        series: with_.map(c => ({
            name: chains.length > 1 ? c.name : '', colour: c.colourName(), x: c.peaks.force.map((_, k) => k), y: c.peaks.force,
            error: c.peaks.uncertainty, points: count > 300 ? 0 : 2.4, hollow: k => c.peaks.open.includes(k), chain: c
        })),
        label: 'Peak force of each contact. ' + with_.map(c => `${chainName(c)}: from ${peakText(c, 0)} at the striker to ${peakText(c, c.peaks.force.length - 1)} at the end`).join('; '),
        tip: (series, k) => [[`var(${series.colour})`, `${series.name ? series.name + ', ' : ''}contact ${k}`, ''], ['', 'peak', peakText(series.chain, k)], ['', 'at', peakTime(series.chain, k)]],
        pick: k => choose({place: clamp(k - chains[0].first, 0, Math.max(...chains.map(c => c.values)) - 1), sample: null})
    });
    const open = with_.some(c => c.peaks.open.length > 0);
    element('peaks-note').textContent = 'Contact k is between beads k and k + 1; the striker is bead 0. Bars are uncertainties, drawn where they are seen.' + (open ? ' Hollow: still rising at the end.' : '');
    buildTable(element('peaks-table'), ['contact', ...with_.flatMap(c => [`${c.name ? c.name + ': ' : ''}peak force`, 'time'])],
               Array.from({length: count}, (_, k) => [String(k), ...with_.flatMap(c => k < c.peaks.force.length ? [peakText(c, k) + (c.peaks.open.includes(k) ? ' (open)' : ''), peakTime(c, k)] : ['', ''])]));
}

/* As tables of peaks have them. */
const peakRows = () => chains.filter(c => c.peaks).flatMap(c => c.peaks.force.map((force, k) => ({
    ...chainColumn(c), contact: k, peak_force_N: force, time_s: c.peaks.time[k], state: c.peaks.open.includes(k) ? 'open' : '', uncertainty_N: c.peaks.uncertainty[k],
    time_s_uncertainty: c.peaks.time_uncertainty[k]
})));

/* ---- numbers ---- */

/* A measure of a chain, "" where it has none. Lengths in beads have no prefix. */
function measureText(chain, name) {
    const found = (chain.measures || []).find(m => m.name === name);
    if (!found || found.value === null)
        return '';
    const whole = /^(beads|contacts|1\/bead)$/.test(found.unit), unit = whole ? '' : found.unit;
    const text = (found.uncertainty > 0 ? uncertain(found.value, found.uncertainty, unit) : quantity(found.value, unit, 4)) + (whole ? ' ' + found.unit : '');
    return found.note ? `${text} (${found.note})` : text;
}

/* Rows of the table of numbers: a name, and its value for a chain; rows without any value are left out. */
const numberRows = [
    ['beads', c => c.displacement ? String(c.total) : ''],
    ['points', c => c.displacement ? '' : String(c.total)],
    ['magnetism M', c => c.magnetism === undefined ? '' : figures(c.magnetism, 4)],
    ['striker', c => c.striker ? quantity(c.striker, 'm/s').replace(/^(\d+) mm/, (_, n) => `${n / 1000} m`) : ''],
    ['largest contact force', c => c.peaks ? (k => `${peakText(c, k)} (contact ${k})`)(c.peaks.force.reduce((b, f, k) => f > c.peaks.force[b] ? k : b, 0)) : ''],
    ['peak force of the last contact', c => c.peaks ? peakText(c, c.peaks.force.length - 1) : ''],
    ['peak force half way', c => c.peaks ? (k => `${peakText(c, k)} (contact ${k})`)(Math.floor(c.peaks.force.length / 2)) : ''],
    ['least certain peak', c => {
        if (!c.peaks || !c.peaks.uncertainty.length)
            return '';
        const part = k => c.peaks.uncertainty[k] / c.peaks.force[k] || 0;
        const k = c.peaks.force.reduce((b, _, i) => !c.peaks.open.includes(i) && part(i) > part(b) ? i : b, 0); /* open ones still rise */
        return `${peakText(c, k)} (contact ${k})`;
    }],
    ['front arrives at the end', c => c.run && c.run.arrival ? quantity(c.run.arrival, data.time.unit, 5) : ''],
    ['speed of the front', c => measureText(c, 'front speed')],
    ['width of the force at half height', c => measureText(c, 'force width')],
    ['part of the energy in the leading pulse', c => measureText(c, 'pulse part of energy')],
    ['participation of energies', c => measureText(c, 'participation of energies')],
    ['clean index', c => measureText(c, 'clean index')],
    ['simulated time', c => c.run ? quantity(c.run.end, data.time.unit, 6) : ''],
    ['method', c => c.run ? c.run.method : ''],
    ['step', c => c.run && c.run.step ? quantity(c.run.step, data.time.unit) : ''],
    ['error seen: energy', c => c.run && c.run.energyError !== null ? figures(c.run.energyError, 2) : ''],
    ['error seen: embedded method', c => c.run && c.run.embeddedError !== null ? figures(c.run.embeddedError, 2) : ''],
    ['error seen: contact events', c => c.run && c.run.eventError !== null ? figures(c.run.eventError, 2) : '']
];
function showNumbers() {
    const rows = numberRows.map(([name, of]) => [name, ...chains.map(of)]);
    for (const name of new Set(chains.flatMap(c => c.peaks ? c.sensors.map(s => s.name) : []))) {
        rows.push([`peak force in front of sensor ${name}`, ...chains.map(c => {
            const sensor = c.sensors.find(s => s.name === name), k = sensor && sensor.bead - 1;
            return sensor && k >= 0 ? `${peakText(c, k)} (contact ${k})` : '';
        })]);
    }
    buildTable(element('numbers-table'), ['', ...chains.map(c => c.name || 'chain')], rows.filter(([, ...values]) => values.some(v => v)));
    const measures = [...new Set(chains.flatMap(c => (c.measures || []).map(m => m.name)))];
    element('measures').hidden = measures.length === 0;
    buildTable(element('measures-table'), ['', ...chains.map(c => c.name || 'chain')], measures.map(name => [name, ...chains.map(c => measureText(c, name))]));
}

/* What the films say in their second line. */
function showFacts() {
    const facts = [];
    const named = chains[0].material ? chains.flatMap(c => c.material).map(m => data.materials[m].name) : [];
    const used = [...new Set(named)]; // those that differ in size only have one name
    if (used.length)
        facts.push(used.join(' : '));
    const speeds = new Set(chains.map(c => c.striker));
    if (speeds.size === 1 && chains[0].striker)
        facts.push(`striker ${chains[0].striker} m/s`);
    if (chains[0].displacement && data.magnify !== 1)
        facts.push(`displacements × ${figures(data.magnify, 3)}`);
    if (data.time.held)
        facts.push(`${data.field.name.replace('-', ' ')}: the largest in ${quantity(data.time.every, data.time.unit, 2)}`);
    for (const fact of facts) {
        const made = document.createElement('b');
        made.textContent = fact;
        element('facts').append(made, ' ');
    }
}

function refresh() {
    layOut();
    showOne();
    showPeaks();
    redraw();
}
function startRun() {
    buildStage();
    buildControls();
    buildOne();
    addSaves(element('saves'), 'this picture', () => clockText(timeOf(state.sample)), profileRows, stageDrawing);
    if (chains.some(c => c.peaks))
        addSaves(element('peaks-title').parentElement, 'the peaks', () => 'peaks', peakRows, () => chartDrawing(element('peaks-chart')));
    element('pictures').hidden = !document.querySelector('#pictures figure');
    showFacts();
    showNumbers();
    element('hint-what').textContent = chains[0].axis.counts ? chains[0].axis.title : 'point';
    const arrivals = chains.map(c => c.run && c.run.arrival).filter(t => t > 0);
    const first = arrivals.length ? 0.62 * (Math.min(...arrivals) - data.time.start) / data.time.every : 0.4 * (samples - 1);
    state.sample = clamp(Math.round(first), 0, samples - 1);
    play(false);
    clearTimeout(link.timer);
    followLink();
    refresh();
    addEventListener('hashchange', () => { followLink(); showOne(); redraw(); });
    let wide = innerWidth, high = innerHeight;
    addEventListener('resize', () => { /* phones resize as they scroll */
        if (innerWidth === wide && Math.abs(innerHeight - high) < 120)
            return;
        wide = innerWidth, high = innerHeight;
        refresh();
    });
    dark.addEventListener('change', refresh);
    addEventListener('beforeprint', refresh);
}

startRun();
/* For tests and consoles: SI units and numbers of beads. */
window.report = {
    data, state, chains, canvases, play, setZoom,
    seek(time) { seek((time - data.time.start) / data.time.every); draw(); },
    choose(place) { choose({place, sample: null}); draw(); },
    colour: beadColour, ticks: scaledTicks,
};
