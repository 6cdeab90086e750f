/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stages of fourier.c, for numbers taken WIDTH at a time as a PACK. Included there for each width: NAME() makes the names of
 * its functions, LOOSE is a PACK anywhere in memory, and ZERO a PACK of zeros. Each number has the same operations in the same
 * order at every width, so results have the same bits. */

/* Transforms four complex numbers, not yet turned. Real and imaginary parts alternate. */
INLINED void NAME(four)(const PACK in[8], PACK out[8])
{
    const PACK sum_re = in[0] + in[4], sum_im = in[1] + in[5], gap_re = in[0] - in[4], gap_im = in[1] - in[5];
    const PACK odd_re = in[2] + in[6], odd_im = in[3] + in[7], rest_re = in[2] - in[6], rest_im = in[3] - in[7];
    out[0] = sum_re + odd_re;
    out[1] = sum_im + odd_im;
    out[2] = gap_re + rest_im;
    out[3] = gap_im - rest_re;
    out[4] = sum_re - odd_re;
    out[5] = sum_im - odd_im;
    out[6] = gap_re - rest_im;
    out[7] = gap_im + rest_re;
}

INLINED void NAME(by_four)(const struct stage *s, struct split x, struct split y)
{
    const size_t n = s->stride, far = n * s->m;
    for (size_t k = 0; k < s->m; k++) {
        for (size_t q = 0; q < n; q += WIDTH) {
            const size_t to = 4 * n * k + q;
            PACK in[8], out[8];
            for (size_t r = 0; r < 4; r++) {
                in[2 * r] = *(const LOOSE *)(x.re + n * k + q + r * far);
                in[2 * r + 1] = *(const LOOSE *)(x.im + n * k + q + r * far);
            }
            NAME(four)(in, out);
            *(LOOSE *)(y.re + to) = out[0];
            *(LOOSE *)(y.im + to) = out[1];
            for (size_t r = 1; r < 4; r++) {
                const struct bead_complex w = s->turn[r * k * s->unit];
                *(LOOSE *)(y.re + to + r * n) = out[2 * r] * w.re - out[2 * r + 1] * w.im;
                *(LOOSE *)(y.im + to + r * n) = out[2 * r] * w.im + out[2 * r + 1] * w.re;
            }
        }
    }
}

INLINED void NAME(by_two)(const struct stage *s, struct split x, struct split y)
{
    const size_t n = s->stride, far = n * s->m;
    for (size_t k = 0; k < s->m; k++) {
        const struct bead_complex w = s->turn[k * s->unit];
        for (size_t q = 0; q < n; q += WIDTH) {
            const size_t from = n * k + q, to = 2 * n * k + q;
            const PACK a_re = *(const LOOSE *)(x.re + from), b_re = *(const LOOSE *)(x.re + from + far);
            const PACK a_im = *(const LOOSE *)(x.im + from), b_im = *(const LOOSE *)(x.im + from + far);
            const PACK gap_re = a_re - b_re, gap_im = a_im - b_im;
            *(LOOSE *)(y.re + to) = a_re + b_re;
            *(LOOSE *)(y.im + to) = a_im + b_im;
            *(LOOSE *)(y.re + to + n) = gap_re * w.re - gap_im * w.im;
            *(LOOSE *)(y.im + to + n) = gap_re * w.im + gap_im * w.re;
        }
    }
}

/* Odd p, inlined with its value if small. The roots of unity for r and p - r are conjugates. */
INLINED void NAME(by_odd)(const struct stage *s, size_t p, struct split x, struct split y)
{
    const size_t n = s->stride, far = n * s->m, root = s->unit * s->m;
    for (size_t i = 0; i < far; i += WIDTH) { /* number q of column k */
        const size_t k = i / n, q = i % n, to = n * p * k + q;
        PACK sum_re = *(const LOOSE *)(x.re + i), sum_im = *(const LOOSE *)(x.im + i);
        for (size_t t = 1; t < p; t++) {
            sum_re = sum_re + *(const LOOSE *)(x.re + i + t * far);
            sum_im = sum_im + *(const LOOSE *)(x.im + i + t * far);
        }
        *(LOOSE *)(y.re + to) = sum_re;
        *(LOOSE *)(y.im + to) = sum_im;
        for (size_t r = 1; 2 * r < p; r++) {
            const struct bead_complex w = s->turn[k * r * s->unit], back = s->turn[k * (p - r) * s->unit];
            PACK even_re = *(const LOOSE *)(x.re + i), even_im = *(const LOOSE *)(x.im + i), odd_re = ZERO, odd_im = odd_re;
            for (size_t t = 1; 2 * t < p; t++) {
                const struct bead_complex u = s->turn[t * r % p * root];
                const size_t b = i + t * far, c = i + (p - t) * far;
                const PACK b_re = *(const LOOSE *)(x.re + b), c_re = *(const LOOSE *)(x.re + c);
                const PACK b_im = *(const LOOSE *)(x.im + b), c_im = *(const LOOSE *)(x.im + c);
                even_re = even_re + u.re * (b_re + c_re);
                even_im = even_im + u.re * (b_im + c_im);
                odd_re = odd_re + u.im * (b_im - c_im);
                odd_im = odd_im + u.im * (b_re - c_re);
            }
            const PACK one_re = even_re - odd_re, one_im = even_im + odd_im, two_re = even_re + odd_re, two_im = even_im - odd_im;
            *(LOOSE *)(y.re + to + r * n) = one_re * w.re - one_im * w.im;
            *(LOOSE *)(y.im + to + r * n) = one_re * w.im + one_im * w.re;
            *(LOOSE *)(y.re + to + (p - r) * n) = two_re * back.re - two_im * back.im;
            *(LOOSE *)(y.im + to + (p - r) * n) = two_re * back.im + two_im * back.re;
        }
    }
}

INLINED void NAME(stage)(const struct stage *s, struct split x, struct split y)
{
    if (s->p == 4)
        NAME(by_four)(s, x, y);
    else if (s->p == 5)
        NAME(by_odd)(s, 5, x, y);
    else if (s->p == 3)
        NAME(by_odd)(s, 3, x, y);
    else if (s->p == 2)
        NAME(by_two)(s, x, y);
    else
        NAME(by_odd)(s, s->p, x, y);
}

#undef PACK
#undef LOOSE
#undef WIDTH
#undef ZERO
#undef NAME
