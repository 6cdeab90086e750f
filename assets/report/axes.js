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

/* Ticks of an uneven scale: even steps first, then smaller round numbers where there is room for a label. */
function scaledTicks(scale, low, high, length, room) {
    const wanted = roundTicks(low, high, Math.max(2, length / room / 2)), ticks = [];
    const reach = Math.max(Math.abs(low), Math.abs(high));
    for (let e = Math.floor(Math.log10(reach)); scale !== 'linear' && e > Math.log10(reach) - 2.5; e--) {
        for (const s of [5, 2, 1])
            wanted.push(s * Math.pow(10, e), -s * Math.pow(10, e));
    }
    for (const value of wanted) {
        const place = along(scale, low, high, value);
        if (value >= low && value <= high && ticks.every(t => Math.abs(t.place - place) * length >= room))
            ticks.push({value, place});
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
function drawBar(canvas, upright, width, height) {
    const context = prepare(canvas, width, height), {low, high, scale} = data.range;
    const box = upright ? {x: 6, y: 44, w: 14, h: height - 44 - 34} : {x: 12, y: 2, w: width - 24, h: 9};
    const {factor, title} = fieldTitle(), map = colourMap();
    const length = upright ? box.h : box.w;
    for (let i = 0; i < 256; i++) {
        context.fillStyle = `rgb(${map[3 * i]},${map[3 * i + 1]},${map[3 * i + 2]})`;
        if (upright)
            context.fillRect(box.x, box.y + box.h * (255 - i) / 256, box.w, box.h / 256 + 0.6);
        else
            context.fillRect(box.x + box.w * i / 256, box.y, box.w / 256 + 0.6, box.h);
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
    canvas.setAttribute('aria-label', `Colours: ${data.field.title} from ${quantity(low, data.field.unit)} to ${quantity(high, data.field.unit)}`);
}
