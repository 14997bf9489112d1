/* Samples with a depth buffer, and triangles: each sample keeps what is nearest to the eye. */
#include "output/raster.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

static const double half_line = 0.4 * CIPC_RASTER_SAMPLES; /* samples: half the width of a mesh edge */

bool cipc_raster_init(cipc_raster *raster, int pixel_width, int pixel_height)
{
    raster->width = pixel_width * CIPC_RASTER_SAMPLES;
    raster->height = pixel_height * CIPC_RASTER_SAMPLES;
    const size_t samples = (size_t)raster->width * (size_t)raster->height;
    raster->depth = cipc_alloc(samples, sizeof raster->depth[0]);
    raster->light = cipc_alloc(samples, sizeof raster->light[0]);
    raster->key = cipc_alloc(samples, sizeof raster->key[0]);
    if (raster->depth == NULL || raster->light == NULL || raster->key == NULL) {
        cipc_raster_free(raster);
        return false;
    }
    return true;
}

void cipc_raster_free(cipc_raster *raster)
{
    cipc_free(raster->depth);
    cipc_free(raster->light);
    cipc_free(raster->key);
    raster->depth = NULL;
    raster->light = NULL;
    raster->key = NULL;
}

void cipc_raster_clear(cipc_raster *raster, cipc_colour top, cipc_colour bottom)
{
    for (int y = 0; y < raster->height; y++) {
        const double t = (y + 0.5) / raster->height;
        const float r = (float)cipc_srgb_to_linear(top.r + t * (bottom.r - top.r));
        const float g = (float)cipc_srgb_to_linear(top.g + t * (bottom.g - top.g));
        const float b = (float)cipc_srgb_to_linear(top.b + t * (bottom.b - top.b));
        for (int x = 0; x < raster->width; x++) {
            const size_t at = (size_t)y * (size_t)raster->width + (size_t)x;
            raster->depth[at] = 0;
            raster->key[at] = 0;
            raster->light[at][0] = r;
            raster->light[at][1] = g;
            raster->light[at][2] = b;
        }
    }
}

/* Twice the signed area of (a, b, p). */
static double area2(const cipc_raster_corner *a, const cipc_raster_corner *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

void cipc_raster_range(double lowest, double highest, int size, int *first, int *last)
{
    *first = lowest <= 0 ? 0 : lowest >= size ? size : (int)lowest;
    *last = highest < 0 ? -1 : highest >= size ? size - 1 : (int)highest;
}

/* Distance of a sample with barycentric weights w to the nearest edge; altitude[i] is the distance of corner i from the edge across. */
static double edge_distance(const double w[3], const double altitude[3])
{
    return fmin(w[0] * altitude[0], fmin(w[1] * altitude[1], w[2] * altitude[2]));
}

void cipc_raster_put(cipc_raster *raster, int x, int y, double inverse_depth, cipc_shade shade, cipc_colour colour)
{
    const size_t at = (size_t)y * (size_t)raster->width + (size_t)x;
    if ((float)inverse_depth > raster->depth[at]) {
        raster->depth[at] = (float)inverse_depth;
        raster->light[at][0] = (float)(shade.brightness * colour.r);
        raster->light[at][1] = (float)(shade.brightness * colour.g);
        raster->light[at][2] = (float)(shade.brightness * colour.b);
        raster->key[at] = shade.brightness > 0 ? (float)(shade.key / shade.brightness) : 0;
    }
}

/* Weighted mean of the corners', times a factor. */
static cipc_shade mean_shade(const cipc_raster_corner c[3], const double w[3], double factor)
{
    cipc_shade shade = {0, 0};
    for (int i = 0; i < 3; i++) {
        shade.brightness += factor * w[i] * c[i].shade.brightness;
        shade.key += factor * w[i] * c[i].shade.key;
    }
    return shade;
}

void cipc_raster_triangle(cipc_raster *raster, const cipc_raster_corner c[3], cipc_colour colour, double ink)
{
    const double area = area2(&c[0], &c[1], c[2].x, c[2].y);
    if (!isfinite(area) || area == 0) {
        return;
    }
    double altitude[3];
    for (int i = 0; i < 3; i++) {
        const cipc_raster_corner *a = &c[(i + 1) % 3], *b = &c[(i + 2) % 3];
        altitude[i] = fabs(area) / hypot(b->x - a->x, b->y - a->y);
    }
    int left, right, top, bottom;
    cipc_raster_range(fmin(c[0].x, fmin(c[1].x, c[2].x)), fmax(c[0].x, fmax(c[1].x, c[2].x)), raster->width, &left, &right);
    cipc_raster_range(fmin(c[0].y, fmin(c[1].y, c[2].y)), fmax(c[0].y, fmax(c[1].y, c[2].y)), raster->height, &top, &bottom);
    for (int y = top; y <= bottom; y++) {
        for (int x = left; x <= right; x++) {
            const double sx = x + 0.5, sy = y + 0.5;
            const double w[3] = {area2(&c[1], &c[2], sx, sy) / area, area2(&c[2], &c[0], sx, sy) / area,
                                 area2(&c[0], &c[1], sx, sy) / area};
            if (w[0] < 0 || w[1] < 0 || w[2] < 0) {
                continue;
            }
            const double inverse_depth = w[0] * c[0].inverse_depth + w[1] * c[1].inverse_depth + w[2] * c[2].inverse_depth;
            const double white = ink > 0 && edge_distance(w, altitude) < half_line ? 1 - ink : 1;
            cipc_raster_put(raster, x, y, inverse_depth, mean_shade(c, w, white), colour);
        }
    }
}

static uint32_t eight_bits(double linear)
{
    const double encoded = cipc_linear_to_srgb(fmin(fmax(linear, 0), 1));
    return (uint32_t)lround(255 * encoded);
}

static uint32_t pixel_value(const cipc_raster *raster, int x, int y)
{
    double sum[3] = {0, 0, 0};
    for (int j = 0; j < CIPC_RASTER_SAMPLES; j++) {
        for (int i = 0; i < CIPC_RASTER_SAMPLES; i++) {
            const size_t row = (size_t)(y * CIPC_RASTER_SAMPLES + j), column = (size_t)(x * CIPC_RASTER_SAMPLES + i);
            const float *light = raster->light[row * (size_t)raster->width + column];
            for (int k = 0; k < 3; k++) {
                sum[k] += fminf(light[k], 1);
            }
        }
    }
    const double samples = CIPC_RASTER_SAMPLES * CIPC_RASTER_SAMPLES;
    return eight_bits(sum[0] / samples) << 16 | eight_bits(sum[1] / samples) << 8 | eight_bits(sum[2] / samples);
}

void cipc_raster_resolve(const cipc_raster *raster, cairo_surface_t *surface, int left, int top)
{
    cairo_surface_flush(surface);
    unsigned char *pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < raster->height / CIPC_RASTER_SAMPLES; y++) {
        uint32_t *row = (uint32_t *)(void *)(pixels + (ptrdiff_t)(top + y) * stride);
        for (int x = 0; x < raster->width / CIPC_RASTER_SAMPLES; x++) {
            row[left + x] = pixel_value(raster, x, y);
        }
    }
    cairo_surface_mark_dirty(surface);
}
