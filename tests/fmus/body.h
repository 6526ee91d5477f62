/* A free rigid body in space under gravity along -z, with its marker in the centre of mass. Parameters m, three moments of inertia, gravity;
 * states position, quaternion from body to space, velocity, angular velocity in the axes of the body; inputs force and moment in space;
 * outputs velocity and acceleration of rotation in space, and acceleration. */
static void turn(const double *q, const double *v, double sign, double *to) {
    double w = q[0], x = sign * q[1], y = sign * q[2], z = sign * q[3];
    double a = y * v[2] - z * v[1], b = z * v[0] - x * v[2], c = x * v[1] - y * v[0];
    to[0] = v[0] + 2 * (w * a + y * c - z * b);
    to[1] = v[1] + 2 * (w * b + z * a - x * c);
    to[2] = v[2] + 2 * (w * c + x * b - y * a);
}

static void rates(const double *p, const double *s, const double *u, double *r) {
    const double *q = s + 3, *o = s + 10;
    double m[3];
    turn(q, u + 3, -1, m);
    for (int i = 0; i < 3; i++) {
        r[i] = s[7 + i];
        r[7 + i] = u[i] / p[0] - (i == 2 ? p[4] : 0);
    }
    r[3] = -0.5 * (q[1] * o[0] + q[2] * o[1] + q[3] * o[2]);
    r[4] = 0.5 * (q[0] * o[0] + q[2] * o[2] - q[3] * o[1]);
    r[5] = 0.5 * (q[0] * o[1] + q[3] * o[0] - q[1] * o[2]);
    r[6] = 0.5 * (q[0] * o[2] + q[1] * o[1] - q[2] * o[0]);
    r[10] = (m[0] - (p[3] - p[2]) * o[1] * o[2]) / p[1];
    r[11] = (m[1] - (p[1] - p[3]) * o[2] * o[0]) / p[2];
    r[12] = (m[2] - (p[2] - p[1]) * o[0] * o[1]) / p[3];
}

static void outputs_of(const double *p, const double *s, const double *u, double *y) {
    double r[13];
    rates(p, s, u, r);
    turn(s + 3, s + 10, 1, y);
    memcpy(y + 3, r + 7, 3 * sizeof(double));
    turn(s + 3, r + 10, 1, y + 6);
}

static const struct equation EQUATION = {13, 6, 9, {1, 1, 1, 1, 9.81}, {0, 0, 0, 1}, rates, outputs_of};
