/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of the report: samples unpacked, values between samples, quantities with units, colours. */

const data = JSON.parse(document.getElementById('data').textContent);
const element = id => document.getElementById(id);

function bytes(base64) {
    const text = atob(base64), out = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++)
        out[i] = text.charCodeAt(i);
    return out;
}

/* Samples are whole numbers of 16 bits; a value is `step` times one. */
function unpack(packed) {
    const raw = bytes(packed.data), view = new DataView(raw.buffer);
    const whole = packed.signed ? new Int16Array(raw.length / 2) : new Uint16Array(raw.length / 2);
    for (let i = 0; i < whole.length; i++)
        whole[i] = packed.signed ? view.getInt16(2 * i, true) : view.getUint16(2 * i, true);
    return {whole, step: packed.step};
}

/* Value `i` of a series of `n` values a sample, at a sample that need not be whole. */
function between(series, n, i, sample) {
    const last = series.whole.length / n - 1, s = Math.max(0, Math.min(last, sample)), k = Math.min(last, Math.floor(s));
    const a = series.whole[k * n + i], b = series.whole[Math.min(last, k + 1) * n + i];
    return series.step * (a + (s - k) * (b - a));
}

/* ---- words ---- */

const prefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']];

/* The prefix that suits numbers of this size: its factor and sign. */
function prefix(size, unit) {
    if (!unit || !(Math.abs(size) > 0) || !isFinite(size))
        return [1, ''];
    return prefixes.find(p => Math.abs(size) >= p[0] * 0.99999) || prefixes[prefixes.length - 1];
}
function figures(value, digits) {
    if (value === 0)
        return '0';
    const size = Math.abs(value);
    if (size < 1e6 && size >= 1e-4)
        return String(Number(value.toPrecision(digits))).replace('-', '−');
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const raised = [...exponent.replace('+', '')].map(c => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] || '⁻').join('');
    return `${Number(mantissa)} × 10${raised}`.replace('-', '−');
}
function quantity(value, unit, digits = 4) {
    if (value === null || value === undefined || !isFinite(value))
        return '–';
    const [factor, sign] = prefix(value, unit);
    return figures(value / factor, digits) + (unit ? ' ' + sign + unit : '');
}
/* A value to the digit in which its uncertainty begins, one more after a 1. */
function uncertain(value, error, unit) {
    if (!(error > 0))
        return quantity(value, unit, 6);
    const size = Math.max(Math.abs(value), error);
    if (!unit && !(size < 1e6 && size >= 1e-4)) /* as figures writes them; 5 % more are never rounded to less */
        return `${figures(value, Math.max(1, Math.min(15, 2 + Math.floor(Math.log10(Math.abs(value) / error)))))} ± ${figures(1.05 * error, 2)}`;
    const [factor, sign] = prefix(value, unit), decimals = Math.max(0, Math.min(9, -Math.floor(Math.log10(error / factor / 2))));
    const step = Math.pow(10, -decimals);
    return `${(value / factor).toFixed(decimals).replace('-', '−')} ± ${(Math.ceil(error / factor / step - 1e-9) * step).toFixed(decimals)} ${sign}${unit}`;
}
/* All times of the page have one unit. */
const timeUnit = data.time ? prefix(data.time.start + data.time.every * (data.time.count - 1), data.time.unit) : [1, ''];
const timeName = data.time && data.time.unit ? timeUnit[1] + data.time.unit : '';
const timeDigits = data.time ? Math.max(0, Math.min(6, Math.ceil(-Math.log10(data.time.every / timeUnit[0])))) : 0;
const clockText = time => (time / timeUnit[0]).toFixed(timeDigits) + (timeName ? ' ' + timeName : '');

/* A time with or without a unit, such as 1.2ms, else null. */
function readTime(text) {
    const found = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?) *([^\d ]*)$/i.exec(text || ''), unit = data.time.unit;
    const words = found && (found[2] || unit).replace(/^[uμ]/, 'µ'), sign = words && words.slice(0, words.length - unit.length);
    const known = found && words.endsWith(unit) && (unit || !words) && prefixes.find(p => p[1] === (sign || ''));
    return known ? Number(found[1]) * known[0] : null;
}
const writtenTime = time => clockText(time).replace(' ', '').replace('µ', 'u');

/* ---- colours ---- */

const dark = matchMedia('(prefers-color-scheme: dark)');
const maps = {light: bytes(data.maps.light), dark: bytes(data.maps.dark)};
const colourMap = () => dark.matches ? maps.dark : maps.light;
const style = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

const scales = {
    linear: x => x,
    sqrt: x => x < 0 ? -Math.sqrt(-x) : Math.sqrt(x),
    log: x => x > 0 ? Math.log(x) : -Infinity,
};
/* 0..1 along a scale, not clamped. */
const along = (scale, low, high, value) =>
    (scales[scale](value) - scales[scale](low)) / (scales[scale](high) - scales[scale](low));
const clamp = (x, low = 0, high = 1) => x < low ? low : x > high ? high : x;
/* Place of a value on the colour bar, and its colour: 256 equal bands. */
const barPlace = value => along(data.range.scale, data.range.low, data.range.high, value);
const colourIndex = value => {
    const place = barPlace(value) * 256;
    return place >= 255 ? 255 : place > 0 ? Math.floor(place) : 0;
};
/* A bead has the colour of its material near its value at rest, that of the map from 0.3 of the bar on. */
function beadColour(own, value) {
    const rest = clamp(data.range.scale === 'log' ? 0 : barPlace(data.range.rest)), map = colourMap(), index = 3 * colourIndex(value);
    let weight = clamp(Math.abs(clamp(barPlace(value)) - rest) / 0.3);
    weight *= weight * (3 - 2 * weight);
    return [0, 1, 2].map(c => Math.round((1 - weight) * own[c] + weight * map[index + c]));
}
