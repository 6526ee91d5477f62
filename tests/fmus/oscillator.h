/* m x'' = -c x - d x' + f. Parameters m, c, d; states x, v; input f; output a. */
static void rates(const double *p, const double *s, const double *u, double *r) {
    r[0] = s[1];
    r[1] = (u[0] - p[1] * s[0] - p[2] * s[1]) / p[0];
}

static void outputs_of(const double *p, const double *s, const double *u, double *y) {
    double r[2];
    rates(p, s, u, r);
    y[0] = r[1];
}

static const struct equation EQUATION = {2, 1, 1, {1}, {0}, rates, outputs_of};
