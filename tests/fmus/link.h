/* A free link in the plane under gravity. Parameters m, inertia, half length, gravity; states x, y, angle and their rates at the centre;
 * inputs fx, fy, moment at the end; outputs of the end, which is half a length from the centre. */
static void rates(const double *p, const double *s, const double *u, double *r) {
    memcpy(r, s + 3, 3 * sizeof(double));
    r[3] = u[0] / p[0];
    r[4] = u[1] / p[0] - p[3];
    r[5] = (u[2] + p[2] * (cos(s[2]) * u[1] - sin(s[2]) * u[0])) / p[1];
}

static void outputs_of(const double *p, const double *s, const double *u, double *y) {
    double r[6], ex = cos(s[2]), ey = sin(s[2]), l = p[2];
    rates(p, s, u, r);
    double all[9] = {
        s[0] + l * ex, s[1] + l * ey, s[2],
        s[3] - l * s[5] * ey, s[4] + l * s[5] * ex, s[5],
        r[3] - l * (r[5] * ey + s[5] * s[5] * ex), r[4] + l * (r[5] * ex - s[5] * s[5] * ey), r[5]};
    memcpy(y, all, sizeof all);
}

static const struct equation EQUATION = {6, 3, 9, {1, 1, 0.5, 9.81}, {0}, rates, outputs_of};
