/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Round ticks for axes of any scale, and the colour bar. */

/* About `most` round numbers from low to high, two at least. */
function roundTicks(low, high, most) {
    const raw = (high - low) / Math.max(1, most), unit = Math.pow(10, Math.floor(Math.log10(raw)));
    const steps = [10, 5, 2, 1, 0.5, 0.2].map(s => s * unit);
    let ticks = [];
    for (const step of steps.slice(Math.max(0, steps.findLastIndex(s => s >= raw * 0.999)))) {
        ticks = [];
        for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++)
            ticks.push(Number((k * step).toPrecision(12)));
        if (ticks.length > 1)
            break;
    }
    return ticks;
}
/* Their labels, all with as many decimals as the one that needs most. */
function tickLabels(ticks) {
    const decimals = Math.max(0, ...ticks.map(v => (String(v).split('.')[1] || '').length));
    return ticks.map(v => Math.abs(v) >= 1e6 || String(v).includes('e') ? figures(v, 4) : v.toFixed(decimals).replace('-', '−'));
}

/* Ticks of the colour bar, `room` px apart at least. With square roots: the smallest even steps whose labels fit up to the high end,
 * and small round numbers near zero where they have twice the room, so that those do not crowd. With logarithms: powers of ten. */
function scaledTicks(scale, low, high, length, room) {
    const at = value => along(scale, low, high, value) * length, ticks = [];
    const inside = value => at(value) > -1e-9 * length && at(value) < length * (1 + 1e-9);
    const add = (values, apart) => values.forEach(value => {
        if (inside(value) && ticks.every(t => Math.abs(t.place * length - at(value)) >= apart - 1e-9 * length))
            ticks.push({value, place: at(value) / length});
    });
    const times = (k, step, e) => Number(`${k * step}e${e}`), top = Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))));
    if (scale === 'linear') {
        add(roundTicks(low, high, clamp(length / room, 2, 10)), room);
    } else if (scale === 'log') {
        const decade = length / Math.log10(high / low), every = Math.ceil(room / decade - 1e-9);
        add(Array.from({length: 1 + Math.ceil(length / decade)}, (_, i) => times(1, 1, top - every * i)), room);
        for (let e = top; every === 1 && e >= top - 1 - length / decade; e--)
            add([5, 2].map(k => times(k, 1, e)), room);
    } else {
        const multiples = (step, e) => Array.from({length: 41}, (_, k) => times(k - 20, step, e)).filter(inside);
        const fits = list => list.length > 0 && list.every((v, i) => i === 0 || at(v) - at(list[i - 1]) >= room);
        const steps = [-1, 0, 1].flatMap(e => [1, 2, 5].map(step => multiples(step, top + e)));
        add(steps.find(fits) || [], room);
        for (let e = top; e > top - 3; e--)
            add([5, 2, 1].flatMap(k => [times(k, 1, e), times(-k, 1, e)]), ticks.length < 4 ? room : 2 * room);
    }
    return ticks;
}

/* Sharp on any screen: a context whose unit is the CSS pixel. */
function prepare(canvas, width, height) {
    const ratio = Math.min(3, window.devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
        canvas.width = Math.round(width * ratio);
        canvas.height = Math.round(height * ratio);
    }
    canvas.style.height = height + 'px';
    const context = canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return context;
}
const font = size => `${size}px ${style('font')}`;

/* "force (N)": what values of the field are called on axes, and the factor of their unit. */
function fieldTitle() {
    const {unit, name} = data.field, [factor, sign] = prefix(Math.max(Math.abs(data.range.low), Math.abs(data.range.high)), unit);
    return {factor, title: name.replace('-', ' ') + (unit ? ` (${sign}${unit})` : '')};
}
/* How wide an upright bar is with its title. */
function barWidth() {
    const context = element('bar').getContext('2d');
    context.font = font(13);
    return Math.ceil(clamp(context.measureText(fieldTitle().title).width + 2, 64, 130));
}

/* The colour bar: upright beside the chains, lying above them on narrow screens. */
function drawBar(context, upright, width, height) {
    const {low, high, scale} = data.range;
    const box = upright ? {x: 6, y: 44, w: 14, h: height - 44 - 34} : {x: 12, y: 2, w: width - 24, h: 9};
    const {factor, title} = fieldTitle(), map = colourMap();
    const length = upright ? box.h : box.w;
    for (let i = 0; i < 256; i++) { /* each up to the end, so that no gap shines through */
        const from = i / 256, c = 3 * (upright ? 255 - i : i);
        context.fillStyle = `rgb(${map[c]},${map[c + 1]},${map[c + 2]})`;
        if (upright)
            context.fillRect(box.x, box.y + box.h * from, box.w, box.h * (1 - from));
        else
            context.fillRect(box.x + box.w * from, box.y, box.w * (1 - from), box.h);
    }
    /* A pointed end where there are values beyond. */
    for (const [beyond, index, from, to] of [[data.range.over, 255, 1, 1.03], [data.range.under, 0, 0, -0.03]]) {
        const point = part => upright ? box.y + box.h * (1 - part) : box.x + box.w * part;
        context.fillStyle = `rgb(${map[3 * index]},${map[3 * index + 1]},${map[3 * index + 2]})`;
        context.beginPath();
        if (upright)
            context.moveTo(box.x, point(from)), context.lineTo(box.x + box.w / 2, point(to)), context.lineTo(box.x + box.w, point(from));
        else
            context.moveTo(point(from), box.y), context.lineTo(point(to), box.y + box.h / 2), context.lineTo(point(from), box.y + box.h);
        if (beyond)
            context.fill();
    }
    context.fillStyle = style('ink');
    context.font = font(13);
    context.textBaseline = 'middle';
    const ticks = scaledTicks(scale, low, high, length, upright ? 28 : 40);
    for (const tick of ticks) {
        const text = figures(tick.value / factor, 3);
        if (upright) {
            context.fillText(text, box.x + box.w + 6, box.y + box.h * (1 - tick.place));
        } else if (tick.place * length < length - context.measureText(title).width - 26 || tick.place * length > length) {
            context.textAlign = tick.place < 0.03 ? 'left' : 'center';
            context.fillText(text, box.x + box.w * tick.place, box.y + box.h + 10);
        }
    }
    context.textAlign = upright ? 'left' : 'right';
    context.fillText(title, upright ? 0 : width - 4, upright ? 12 : box.y + box.h + 10);
}
/* Beside the pictures, or above them where they are `narrow`. */
const bar = {narrow: false, width: 0, height: 0};
function showBar(narrow, height) {
    const canvas = element('bar'), {low, high} = data.range;
    canvas.style.width = narrow ? '100%' : barWidth() + 'px';
    Object.assign(bar, {narrow, height, width: narrow ? canvas.parentElement.clientWidth : barWidth()});
    drawBar(prepare(canvas, bar.width, bar.height), !narrow, bar.width, bar.height);
    canvas.setAttribute('aria-label', `Colours: ${data.field.title} from ${quantity(low, data.field.unit)} to ${quantity(high, data.field.unit)}`);
}
