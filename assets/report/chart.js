/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves and points in SVG, with axes, a legend, a line that says "now", and values under the pointer. */

const svgElement = (name, attributes = {}, text) => {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const key in attributes)
        made.setAttribute(key, attributes[key]);
    if (text !== undefined)
        made.textContent = text;
    return made;
};

/* what: {x, y: {title, low, high, factor}, series: [{name, colour, x: [], y: [], error: [], line, points, hollow}], label,
 * rulers, pick(x, found), tip(series, index), plane: the nearest point is meant}. Numbers are SI, `factor` is that of the
 * unit shown. Returns {now(x), mark(x, y)}. */
function drawChart(svg, what) {
    const width = svg.clientWidth || 600, height = svg.clientHeight || 260;
    const crowded = width < 460 && what.series.some(s => s.name), top = crowded ? 46 : 30; /* the legend has a line of its own */
    const box = {x: 52, y: top, w: width - 52 - 12, h: height - top - 42};
    const px = v => box.x + box.w * (v - what.x.low) / (what.x.high - what.x.low);
    const py = v => box.y + box.h * (1 - (v - what.y.low) / (what.y.high - what.y.low));
    svg.textContent = '';
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.setAttribute('aria-label', what.label);
    svg.append(svgElement('rect', {class: 'back', x: box.x, y: box.y, width: box.w, height: box.h}));
    const up = roundTicks(what.y.low / what.y.factor, what.y.high / what.y.factor, box.h / 40), upTexts = tickLabels(up);
    up.forEach((v, i) => {
        const y = py(v * what.y.factor);
        svg.append(svgElement('line', {class: 'grid', x1: box.x, x2: box.x + box.w, y1: y, y2: y}),
                   svgElement('text', {x: box.x - 8, y, 'text-anchor': 'end', dy: '.35em'}, upTexts[i]));
    });
    const across = roundTicks(what.x.low / what.x.factor, what.x.high / what.x.factor, box.w / 80), acrossTexts = tickLabels(across);
    across.forEach((v, i) => svg.append(svgElement('text', {x: px(v * what.x.factor), y: box.y + box.h + 18, 'text-anchor': 'middle'}, acrossTexts[i])));
    svg.append(svgElement('text', {class: 'title', x: 8, y: 18}, what.y.title),
               svgElement('text', {class: 'title', x: box.x + box.w, y: box.y + box.h + 36, 'text-anchor': 'end'}, what.x.title));
    drawLegend(svg, what.series, box);
    for (const ruler of what.rulers || [])
        drawRuler(svg, ruler, box, px, py);
    for (const series of what.series)
        drawSeries(svg, series, px, py);
    const now = svgElement('line', {class: 'now', y1: box.y, y2: box.y + box.h, visibility: 'hidden'});
    svg.append(now);
    svg.onpointermove = event => showNearest(svg, what, px, py, event);
    svg.onpointerleave = hideTip;
    svg.onclick = event => {
        const found = nearest(svg, what, px, py, event);
        if (what.pick && found)
            what.pick(found.series.x[found.index], found);
    };
    return {
        mark(x, y) { /* a ring around a point */
            svg.querySelector('.chosen')?.remove();
            svg.append(svgElement('circle', {class: 'chosen', cx: px(x), cy: py(y), r: 7}));
        },
        now(x) {
            now.setAttribute('visibility', x >= what.x.low && x <= what.x.high ? 'visible' : 'hidden');
            now.setAttribute('x1', px(x));
            now.setAttribute('x2', px(x));
        }
    };
}

/* Text that ends there; what follows `_` up to a blank is set below. */
function words(place, text) {
    const made = svgElement('text', {class: 'ruler-words', 'text-anchor': 'end', ...place}), [plain, low, rest] = text.split(/_(\S+)/);
    made.append(plain);
    if (low)
        made.append(svgElement('tspan', {dy: 4, 'font-size': '0.75em'}, low), svgElement('tspan', {dy: -4}, rest));
    return made;
}
/* A line across the chart with its words: {x or y, band, words}. */
function drawRuler(svg, ruler, box, px, py) {
    const upright = ruler.x !== undefined, at = upright ? px(ruler.x) : py(ruler.y);
    const line = upright ? {x1: at, x2: at, y1: box.y, y2: box.y + box.h} : {x1: box.x, x2: box.x + box.w, y1: at, y2: at};
    if (ruler.band > 0) {
        const size = Math.abs(upright ? px(ruler.x + ruler.band) - at : py(ruler.y + ruler.band) - at);
        const low = clamp(at - size, upright ? box.x : box.y, Infinity), high = Math.min(at + size, upright ? box.x + box.w : box.y + box.h);
        svg.append(svgElement('rect', {class: 'band', ...(upright ? {x: low, y: box.y, width: high - low, height: box.h} : {x: box.x, y: low, width: box.w, height: high - low})}));
    }
    svg.append(svgElement('line', {class: 'ruler', ...line}),
               words(!upright             ? {x: box.x + box.w - 8, y: at + 18}
                     : at > box.x + 150 ? {x: at - 7, y: box.y + 20}
                                        : {x: at + 7, y: box.y + 20, 'text-anchor': 'start'}, ruler.words));
}

function drawLegend(svg, list, box) {
    let right = box.x + box.w;
    for (const series of list.filter(s => s.name).reverse()) {
        const text = svgElement('text', {class: 'legend', x: right, y: box.y - 12, 'text-anchor': 'end'}, series.name);
        svg.append(text);
        right -= (text.getComputedTextLength ? text.getComputedTextLength() : 60) + 8;
        svg.append(svgElement('rect', {x: right - 14, y: box.y - 19, width: 14, height: 4, rx: 2, fill: `var(${series.colour})`}));
        right -= 30;
    }
}

function drawSeries(svg, series, px, py) {
    const colour = `var(${series.colour})`;
    let path = '', pen = false;
    for (let i = 0; i < series.x.length; i++) {
        const y = series.y[i], good = y !== null && isFinite(y);
        if (good)
            path += `${pen ? 'L' : 'M'}${px(series.x[i]).toFixed(2)} ${py(y).toFixed(2)}`;
        pen = good;
    }
    if (series.line !== false)
        svg.append(svgElement('path', {class: 'curve', d: path, stroke: colour, ...(series.dashed ? {'stroke-dasharray': '6 4'} : {})}));
    for (let i = 0; series.error && i < series.x.length; i++) {
        const half = Math.abs(py(series.y[i]) - py(series.y[i] + (series.error[i] || 0)));
        if (half > 1)
            svg.append(svgElement('line', {x1: px(series.x[i]), x2: px(series.x[i]), y1: py(series.y[i]) - half, y2: py(series.y[i]) + half, stroke: colour, 'stroke-width': 2, opacity: 0.6}));
    }
    for (let i = 0; series.points && i < series.x.length; i++) {
        if (series.y[i] === null)
            continue;
        const hollow = series.hollow && series.hollow(i);
        svg.append(svgElement('circle', {
            cx: px(series.x[i]).toFixed(2), cy: py(series.y[i]).toFixed(2), r: series.points, fill: hollow ? 'var(--background)' : colour,
            stroke: colour, ...(series.faint ? {opacity: series.faint} : {}), ...(series.id ? {'data-index': series.id[i]} : {})
        }));
    }
}

/* The point nearest to the pointer: of curves along x, of points in the plane. */
function nearest(svg, what, px, py, event) {
    const box = svg.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    let best = null, least = Infinity;
    for (const series of what.series.filter(s => !s.mute)) {
        for (let i = 0; i < series.x.length; i++) {
            if (series.y[i] === null)
                continue;
            const far = Math.hypot((px(series.x[i]) - x) * (what.plane ? 1 : 8), py(series.y[i]) - y);
            if (far < least)
                least = far, best = {series, index: i};
        }
    }
    return best;
}
function showNearest(svg, what, px, py, event) {
    const found = nearest(svg, what, px, py, event);
    if (found)
        showTip(event, what.tip(found.series, found.index));
}

/* ---- the tip beside the pointer: lines of [colour or '', faint words, value] ---- */

function showTip(event, lines) {
    const tip = element('tip');
    tip.textContent = '';
    for (const [colour, words, value] of lines) {
        const line = document.createElement('div'), name = document.createElement('b');
        if (colour) {
            const mark = document.createElement('i');
            mark.style.background = colour;
            line.append(mark);
        }
        name.textContent = words;
        line.append(name, value ? ' ' + value : '');
        tip.append(line);
    }
    const box = tip.getBoundingClientRect();
    const x = event.clientX + 16 + box.width > innerWidth ? event.clientX - box.width - 12 : event.clientX + 16;
    const y = event.clientY + 16 + box.height > innerHeight ? event.clientY - box.height - 12 : event.clientY + 16;
    tip.style.transform = `translate(${Math.max(4, x)}px, ${Math.max(4, y)}px)`;
    tip.style.visibility = 'visible';
}
function hideTip() {
    element('tip').style.visibility = 'hidden';
}
