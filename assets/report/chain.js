/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One chain on its canvas, as in the films: the row of beads, a lens that follows the front, the profile, the space-time image.
 * Along the chain places are counted in values (beads or contacts) from the first one shown; `zoom` is common to all chains. */

/* State that all chains share. Spans of zoom: of places (values), and of times (samples). */
const state = {sample: 0, playing: false, bead: null, hover: null, zoom: null, overlay: false};
const samples = data.time ? data.time.count : 0;
const timeOf = sample => data.time.start + sample * data.time.every;

class Chain {
    constructor(from, index) {
        Object.assign(this, from);
        this.index = index;
        this.field = unpack(from.field);
        this.displacement = from.displacement ? unpack(from.displacement) : null;
        this.shift = data.field.contacts ? 0.5 : 0; /* contact k is between beads k and k + 1 */
        this.findFront();
    }

    colourName() { return `--curve${this.index % 6}`; }
    value(place, sample) { return between(this.field, this.values, place, sample); }
    bead(i, sample) { /* the value of a bead: of contacts the mean of its two */
        if (!data.field.contacts)
            return this.value(i, sample);
        return 0.5 * ((i > 0 ? this.value(i - 1, sample) : 0) + (i < this.values ? this.value(i, sample) : 0));
    }
    moved(i, sample) { return this.position[i] + data.magnify * between(this.displacement, this.beads, i, sample); }
    number(place) { return this.axis.first + place * this.axis.spacing; }
    materialName(i) { return this.material ? data.materials[this.material[i]].name : ''; }

    /* How far the wave has come, sample by sample: the last bead above a fiftieth of the range, evened out. */
    findFront() {
        const step = this.field.step || 1, rest = data.range.rest / step,
            limit = 0.02 * Math.max(Math.abs(data.range.low / step - rest), Math.abs(data.range.high / step - rest));
        this.front = new Float32Array(samples);
        let front = 0;
        for (let s = 0; s < samples; s++) {
            let i = this.values - 1;
            while (i > front && Math.abs(this.field.whole[s * this.values + i] - rest) < limit)
                i--;
            this.front[s] = front = Math.max(front, i);
        }
        const even = Math.max(1, Math.round(samples / 60)), raw = this.front.slice();
        for (let s = 0, sum = 0; s < samples + even; s++) {
            sum += raw[Math.min(samples - 1, s)] - (s >= 2 * even ? raw[s - 2 * even] : 0);
            if (s >= even)
                this.front[s - even] = sum / Math.min(s + 1, 2 * even);
        }
    }

    /* ---- places ---- */

    /* The position, m, of a place along the row: beads fill it from edge to edge. */
    metres(place) {
        const b = place + this.shift, i = clamp(Math.round(b), 0, this.beads - 1);
        return this.position[i] + 2 * this.radius[i] * (b - i);
    }
    span() { return state.zoom ? state.zoom.places : [-0.5, this.values - 0.5]; }
    times() { return state.zoom ? state.zoom.samples : [0, samples - 1]; }
    x(place) {
        const [a, b] = this.span();
        return this.image.x + this.image.w * (place - a) / (b - a);
    }
    rowX(metres) {
        const [a, b] = this.span(), low = this.metres(a), high = this.metres(b);
        return this.image.x + this.image.w * (0.5 + this.fit * ((metres - low) / (high - low) - 0.5));
    }
    rowScale() {
        const [a, b] = this.span();
        return this.fit * this.image.w / (this.metres(b) - this.metres(a));
    }
    /* What is under a point of the canvas: a place, and a sample where it is in the image. */
    at(x, y) {
        const [a, b] = this.span(), [s, t] = this.times(), i = this.image, l = this.lens;
        if (x < i.x - 4 || x > i.x + i.w + 4)
            return null;
        let place = a + (b - a) * (x - i.x) / i.w;
        if (l && y >= l.y && y < l.y + l.h)
            place = this.nearest(l.from + (x - l.x) / l.scale) - this.shift;
        place = clamp(Math.round(place), 0, this.values - 1);
        const inside = y >= i.y && y <= i.y + i.h;
        return {place, sample: inside ? s + (t - s) * (y - i.y) / i.h : null};
    }
    nearest(metres) {
        let best = 0;
        for (let i = 1; i < this.beads; i++)
            best = Math.abs(this.position[i] - metres) < Math.abs(this.position[best] - metres) ? i : best;
        return best;
    }

    /* Rectangles of the views in a canvas of this size. Returns the height of the beads. */
    arrange(width, height, labels) {
        const left = labels ? 46 : 6, right = this.beads && this.displacement ? 16 : 6;
        const box = {x: left, w: width - left - right};
        let y = 2;
        this.width = width, this.height = height, this.labels = labels;
        this.image = {...box, y: 0, h: 0};
        this.profile = {...box, y: 0, h: 0};
        this.row = this.lens = null;
        this.fit = 1;
        if (this.displacement) {
            const largest = Math.max(...this.radius), diameter = 2 * largest * this.rowScale();
            const room = Math.round(clamp(0.09 * height, 28, 66));
            const lens = diameter < 0.5 * room;
            this.fit = Math.min(1, 0.9 * room / diameter); /* few beads are limited by the height */
            y += this.sensors.length ? 15 : 0; /* their names */
            this.row = {...box, y, h: lens ? Math.ceil(diameter + 6) : room};
            y += this.row.h;
            if (lens) {
                const size = room - 6; /* px of the largest bead */
                this.lens = {...box, y: y + 10, h: room, scale: Math.min(size / (2 * largest), box.w / (7 * 2 * largest)), from: 0};
                y += 10 + room;
            }
        }
        this.picture = null;
        return y;
    }
    /* Profile and image below that height: the same of all chains, as those of the first column have the labels. */
    arrangeBelow(y) {
        const title = 24, below = 22, rest = this.height - y - below - 2 * title;
        Object.assign(this.profile, {y: y + title, h: Math.round(clamp(0.23 * rest, 34, 150))});
        this.image.y = this.profile.y + this.profile.h + title;
        this.image.h = this.height - this.image.y - below;
    }

    /* ---- the image ---- */

    /* Means of all values over a span of samples, linear between them. */
    means(from, to, out) {
        const n = this.values, whole = this.field.whole, last = samples - 1;
        out.fill(0);
        if (to - from < 1) {
            const s = clamp(0.5 * (from + to), 0, last), k = Math.min(last, Math.floor(s)), l = Math.min(last, k + 1), part = s - k;
            for (let i = 0; i < n; i++)
                out[i] = this.field.step * ((1 - part) * whole[k * n + i] + part * whole[l * n + i]);
            return;
        }
        const first = clamp(Math.ceil(from), 0, last), end = clamp(Math.floor(to), first, last);
        for (let k = first; k <= end; k++) {
            for (let i = 0; i < n; i++)
                out[i] += whole[k * n + i];
        }
        for (let i = 0; i < n; i++)
            out[i] *= this.field.step / (end - first + 1);
    }

    /* The space-time image of what is zoomed to, a device pixel each. */
    paint() {
        const ratio = Math.min(3, window.devicePixelRatio || 1), map = colourMap();
        const w = Math.max(1, Math.round(this.image.w * ratio)), h = Math.max(1, Math.round(this.image.h * ratio));
        const [a, b] = this.span(), [s, t] = this.times();
        const picture = document.createElement('canvas'), values = new Float64Array(this.values);
        picture.width = w, picture.height = h;
        const context = picture.getContext('2d'), pixels = context.createImageData(w, h), out = pixels.data;
        const colours = new Int32Array(this.values);
        const column = Int32Array.from({length: w}, (_, x) => clamp(Math.round(a + (b - a) * (x + 0.5) / w), 0, this.values - 1));
        for (let y = 0, to = 0; y < h; y++) {
            this.means(s + (t - s) * y / h, s + (t - s) * (y + 1) / h, values);
            for (let i = 0; i < this.values; i++)
                colours[i] = 3 * colourIndex(values[i]);
            for (let x = 0; x < w; x++, to += 4) {
                const c = colours[column[x]];
                out[to] = map[c], out[to + 1] = map[c + 1], out[to + 2] = map[c + 2], out[to + 3] = 255;
            }
        }
        context.putImageData(pixels, 0, 0);
        this.picture = picture;
    }

    /* ---- drawing ---- */

    draw(context, others) {
        if (!this.picture)
            this.paint();
        if (this.displacement) {
            this.aim();
            this.drawRow(context);
            this.drawSensors(context);
            if (this.lens)
                this.drawLens(context);
        }
        this.drawProfile(context, others);
        this.drawImage(context);
        this.drawLabels(context);
    }

    /* The lens follows the front; where a bead is chosen it shows that. */
    aim() {
        if (!this.lens)
            return;
        const width = this.lens.w / this.lens.scale, largest = Math.max(...this.radius);
        const s = clamp(state.sample, 0, samples - 1), k = Math.floor(s), l = Math.min(samples - 1, k + 1);
        const front = state.bead === null || state.playing ? this.front[k] + (s - k) * (this.front[l] - this.front[k]) : state.bead;
        const low = this.position[0] - 1.6 * largest, high = this.position[this.beads - 1] + 1.8 * largest;
        const back = state.bead === null || state.playing ? 0.62 : 0.5;
        this.lens.from = clamp(this.metres(clamp(front, 0, this.values - 1)) - back * width, low, Math.max(low, high - width));
    }

    ball(context, x, y, r, colour) {
        context.fillStyle = `rgb(${colour})`;
        context.beginPath();
        context.arc(x, y, r, 0, 2 * Math.PI);
        context.fill();
        if (r < 2.5)
            return;
        const shade = context.createRadialGradient(x, y, 0.45 * r, x, y, r);
        shade.addColorStop(0, 'rgba(0,0,0,0)');
        shade.addColorStop(0.6, 'rgba(0,0,0,.12)');
        shade.addColorStop(1, 'rgba(0,0,0,.55)');
        context.fillStyle = shade;
        context.fill();
        const light = context.createRadialGradient(x - 0.36 * r, y - 0.4 * r, 0, x - 0.36 * r, y - 0.4 * r, 0.42 * r);
        light.addColorStop(0, 'rgba(255,255,255,.75)');
        light.addColorStop(1, 'rgba(255,255,255,0)');
        context.fillStyle = light;
        context.fill();
    }
    /* Where a bead is drawn, in the lens where it is there: centre and radius, CSS px. */
    where(i) {
        const metres = this.moved(i, state.sample), l = this.lens, x = l ? l.x + (metres - l.from) * l.scale : 0;
        if (l && x > l.x && x < l.x + l.w)
            return {x, y: l.y + l.h / 2, r: this.radius[i] * l.scale};
        return {x: this.rowX(metres), y: this.row.y + this.row.h / 2, r: this.radius[i] * this.rowScale()};
    }
    colourOf(i) { return beadColour(data.materials[this.material[i]].colour, this.bead(i, state.sample)); }
    clip(context, box, draw) {
        context.save();
        context.beginPath();
        context.rect(box.x, box.y, box.w, box.h);
        context.clip();
        draw();
        context.restore();
    }

    drawRow(context) {
        const scale = this.rowScale(), y = this.row.y + this.row.h / 2, wide = {x: 0, y: this.row.y, w: this.width, h: this.row.h};
        this.clip(context, wide, () => {
            for (let i = 0; i < this.beads; i++) {
                const x = this.rowX(this.moved(i, state.sample)), r = this.radius[i] * scale;
                if (x + r < this.image.x - 12 || x - r > this.image.x + this.image.w + 12)
                    continue;
                this.ball(context, x, y, Math.max(0.8, r), this.colourOf(i));
                if (i === state.bead)
                    this.mark(context, x, y, r + 1.5);
            }
        });
        const end = this.rowX(this.position[this.beads - 1] + this.radius[this.beads - 1]);
        if (this.wall && end <= this.image.x + this.image.w + 2) {
            context.fillStyle = `rgb(${this.wall.colour})`;
            context.fillRect(end, this.row.y, 8, this.row.h);
        }
    }
    /* Names of sensors above the row, those that have room. */
    drawSensors(context) {
        let free = 0;
        context.font = font(11.5);
        context.textAlign = 'center';
        context.textBaseline = 'middle';
        context.fillStyle = style('faint');
        for (const sensor of this.sensors) {
            const x = this.rowX(this.position[sensor.bead - this.firstBead]), half = context.measureText(sensor.name).width / 2;
            context.fillRect(x - 0.5, this.row.y - 4, 1, 5);
            if (!(x - half >= free && x + half <= this.width))
                continue;
            context.fillText(sensor.name, x, this.row.y - 10);
            free = x + half + 8;
        }
    }
    mark(context, x, y, r) {
        context.strokeStyle = style('accent');
        context.lineWidth = 2;
        context.beginPath();
        context.arc(x, y, Math.max(3, r), 0, 2 * Math.PI);
        context.stroke();
    }

    drawLens(context) {
        const l = this.lens, top = this.row.y + this.row.h, accent = style('accent');
        const from = clamp(this.rowX(l.from), l.x, l.x + l.w), to = clamp(this.rowX(l.from + l.w / l.scale), l.x, l.x + l.w);
        context.fillStyle = accent;
        context.globalAlpha = 0.13;
        context.beginPath();
        context.moveTo(from, top), context.lineTo(to, top), context.lineTo(l.x + l.w, l.y), context.lineTo(l.x, l.y);
        context.fill();
        context.globalAlpha = 1;
        context.fillRect(from, top - 1, to - from, 2);
        context.fillStyle = style('panel');
        context.fillRect(l.x, l.y, l.w, l.h);
        this.clip(context, l, () => {
            const y = l.y + l.h / 2, place = metres => l.x + (metres - l.from) * l.scale;
            for (let i = 0; i < this.beads; i++) {
                const x = place(this.moved(i, state.sample)), r = this.radius[i] * l.scale;
                if (x + r < l.x || x - r > l.x + l.w)
                    continue;
                this.ball(context, x, y, r, this.colourOf(i));
                if (i === state.bead)
                    this.mark(context, x, y, r - 1);
            }
            if (this.wall) {
                context.fillStyle = `rgb(${this.wall.colour})`;
                context.fillRect(place(this.position[this.beads - 1] + this.radius[this.beads - 1]), l.y, l.w, l.h);
            }
        });
        context.strokeStyle = accent;
        context.globalAlpha = 0.5;
        context.lineWidth = 1;
        context.strokeRect(l.x - 0.5, l.y - 0.5, l.w + 1, l.h + 1);
        context.globalAlpha = 1;
    }

    profileY(value) {
        const p = this.profile, {low, high} = data.range, from = data.range.scale === 'log' ? 0 : low;
        return p.y + p.h * (1 - (value - from) / (1.06 * (high - from)));
    }
    /* A smooth curve through the values (Catmull and Rom's). */
    curve(context) {
        const [a, b] = this.span(), first = Math.max(0, Math.floor(a)), last = Math.min(this.values - 1, Math.ceil(b));
        const y = i => this.profileY(this.value(clamp(i, 0, this.values - 1), state.sample)), third = (this.x(1) - this.x(0)) / 3;
        const slope = i => (y(i + 1) - y(i - 1)) / 6;
        context.beginPath();
        context.moveTo(this.x(first), y(first));
        for (let i = first; i < last; i++)
            context.bezierCurveTo(this.x(i) + third, y(i) + slope(i), this.x(i + 1) - third, y(i + 1) - slope(i + 1), this.x(i + 1), y(i + 1));
    }
    drawProfile(context, others) {
        const p = this.profile, [a, b] = this.span();
        context.fillStyle = style('panel');
        context.fillRect(p.x, p.y, p.w, p.h);
        this.clip(context, p, () => {
            const first = Math.max(0, Math.floor(a)), last = Math.min(this.values - 1, Math.ceil(b)), rest = this.profileY(data.range.rest);
            for (const other of state.overlay ? others : []) {
                const own = other.image;
                other.image = this.image;
                other.curve(context);
                other.image = own;
                context.strokeStyle = style(other.colourName().slice(2));
                context.lineWidth = 1.5;
                context.stroke();
            }
            this.curve(context);
            context.lineWidth = 1.8;
            context.strokeStyle = style(state.overlay ? this.colourName().slice(2) : 'accent');
            context.stroke();
            context.lineTo(this.x(last), rest), context.lineTo(this.x(first), rest);
            context.fillStyle = context.strokeStyle;
            context.globalAlpha = 0.25;
            context.fill();
            context.globalAlpha = 1;
            if (state.bead !== null)
                this.pointer(context, p, state.bead);
        });
    }
    pointer(context, box, place) {
        context.fillStyle = style('accent');
        context.globalAlpha = 0.7;
        context.fillRect(this.x(place) - 0.5, box.y, 1, box.h);
        context.globalAlpha = 1;
    }

    drawImage(context) {
        const i = this.image, [s, t] = this.times(), now = i.y + i.h * clamp((state.sample - s) / (t - s));
        context.imageSmoothingEnabled = false;
        context.drawImage(this.picture, i.x, i.y, i.w, i.h);
        context.fillStyle = style('panel'); /* what is still to come */
        context.globalAlpha = dark.matches ? 0.55 : 0.72;
        context.fillRect(i.x, now, i.w, i.y + i.h - now);
        context.globalAlpha = 1;
        this.clip(context, i, () => {
            if (state.bead !== null)
                this.pointer(context, i, state.bead);
            if (state.hover && state.hover.sample !== null) {
                context.fillStyle = '#fff';
                context.globalAlpha = 0.45;
                context.fillRect(this.x(state.hover.place) - 0.5, i.y, 1, i.h);
                context.fillRect(i.x, i.y + i.h * (state.hover.sample - s) / (t - s) - 0.5, i.w, 1);
                context.globalAlpha = 1;
            }
            if (state.box && state.box.chain === this) {
                const {x0, y0, x1, y1} = state.box;
                context.strokeStyle = '#fff';
                context.lineWidth = 1.5;
                context.strokeRect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
            }
        });
        context.fillStyle = dark.matches ? '#fff' : style('ink');
        context.fillRect(i.x, now - 0.75, i.w, 1.5);
    }

    drawLabels(context) {
        const i = this.image, p = this.profile, [a, b] = this.span(), [s, t] = this.times();
        const {factor, title} = fieldTitle();
        const from = timeOf(s) / timeUnit[0], to = timeOf(t) / timeUnit[0];
        context.fillStyle = style('ink');
        context.font = font(13);
        context.textBaseline = 'middle';
        context.textAlign = 'right';
        if (this.labels) {
            const write = (ticks, x, y) => tickLabels(ticks).forEach((text, k) => context.fillText(text, x, y(ticks[k])));
            write(roundTicks(data.range.low / factor, data.range.high / factor, Math.max(1.5, p.h / 26)), p.x - 8,
                  v => clamp(this.profileY(v * factor), p.y + 5, p.y + p.h - 4));
            write(roundTicks(from, to, Math.max(2, i.h / 38)), i.x - 8,
                  v => clamp(i.y + i.h * (v - from) / (to - from), i.y + 6, i.y + i.h - 5));
            context.textAlign = 'left';
            context.fillText(title, 2, p.y - 11);
            context.fillText(timeName ? `time (${timeName})` : 'time', 2, i.y - 11);
            context.fillText(this.axis.title, 2, i.y + i.h + 13);
        }
        context.textAlign = 'center';
        const round = roundTicks(this.number(a), this.number(b), Math.max(2, i.w / 62));
        const ticks = round.filter(v => !this.axis.counts || Number.isInteger(v)), texts = tickLabels(ticks);
        ticks.forEach((v, k) => context.fillText(texts[k], clamp(this.x((v - this.axis.first) / this.axis.spacing), i.x + 4, i.x + i.w - 8), i.y + i.h + 13));
    }
}
