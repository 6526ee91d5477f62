/* FMI 2.0 around the solver. ORDERS: highest derivative of inputs that is taken; STATES; BYTES. */
#include "solver.h"

typedef void (*logger)(void *, const char *, int, const char *, const char *, ...);
struct callbacks {
    logger log;
    void *(*allocate)(size_t, size_t);
    void (*free)(void *);
    void (*finished)(void *, int);
    void *environment;
};

static void ask_for_inputs(struct instance *own, double t) { (void)own, (void)t; }

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources,
                      const struct callbacks *callbacks, int visible, int logging) {
    (void)visible, (void)logging;
    if (type != 1 || strcmp(guid, "{linchpin}") || strncmp(resources, "file:///", 8)) {
        callbacks->log(callbacks->environment, name, ERROR, "error", "wrong guid %s", guid);
        return NULL;
    }
    struct instance *own = callbacks->allocate(1, sizeof *own);
    own->environment = callbacks->environment;
    own->logger = (void *)callbacks->log;
    take_defaults(own);
    return own;
}

int fmi2SetupExperiment(struct instance *own, int has_tolerance, double tolerance, double t, int ends, double end) {
    (void)has_tolerance, (void)tolerance, (void)ends, (void)end;
    start(own, t);
    return OK;
}

int fmi2EnterInitializationMode(struct instance *own) { return own->now.p[0] > 0 ? OK : ERROR; }
int fmi2ExitInitializationMode(struct instance *own) { (void)own; return OK; }
int fmi2Terminate(struct instance *own) { (void)own; return OK; }
void fmi2FreeInstance(struct instance *own) { free(own); }
int fmi2GetReal(struct instance *own, const unsigned *vr, size_t n, double *v) { return get(own, vr, n, v); }

int fmi2SetReal(struct instance *own, const unsigned *vr, size_t n, const double *v) {
    own->now.from = own->now.t;
    memset(own->now.du, 0, sizeof own->now.du);
    return set(own, vr, n, v);
}

int fmi2SetInteger(struct instance *own, const unsigned *vr, size_t n, const int *v) {
    (void)vr;
    if (n) own->now.fault = v[0];
    return OK;
}

int fmi2SetBoolean(struct instance *own, const unsigned *vr, size_t n, const int *v) {
    (void)vr;
    if (n) own->now.is_held = v[0];
    return OK;
}

int fmi2SetString(struct instance *own, const unsigned *vr, size_t n, const char *const *v) {
    (void)vr;
    if (n) strncpy(own->label, v[0], sizeof own->label - 1);
    return OK;
}

#ifndef WITHOUT_STEP
int fmi2DoStep(struct instance *own, double t, double h, int never_back) {
    (void)never_back;
    int status = step(own, t, h);
    if (status != OK)
        ((logger)own->logger)(own->environment, "fmu", status, "error",
                              own->label[0] ? own->label : "the spring is broken");
    return status;
}
#endif

#ifdef ORDERS
int fmi2SetRealInputDerivatives(struct instance *own, const unsigned *vr, size_t n, const int *orders, const double *v) {
    for (size_t i = 0; i < n; i++) {
        if (orders[i] > ORDERS) return ERROR;
        own->now.du[vr[i] - INPUT][orders[i]] = v[i];
    }
    return OK;
}
#endif

#ifdef STATES
int fmi2GetFMUstate(struct instance *own, void **state) {
    if (!*state) *state = malloc(sizeof own->now);
    memcpy(*state, &own->now, sizeof own->now);
    return OK;
}
int fmi2SetFMUstate(struct instance *own, void *state) { memcpy(&own->now, state, sizeof own->now); return OK; }
int fmi2FreeFMUstate(struct instance *own, void **state) { (void)own; free(*state); *state = NULL; return OK; }
int fmi2SerializedFMUstateSize(struct instance *own, void *state, size_t *n) { (void)state; *n = sizeof own->now; return OK; }
int fmi2SerializeFMUstate(struct instance *own, void *state, char *to, size_t n) { (void)own; memcpy(to, state, n); return OK; }
int fmi2DeSerializeFMUstate(struct instance *own, const char *from, size_t n, void **state) {
    if (n != sizeof own->now) return ERROR;
    *state = malloc(n);
    memcpy(*state, from, n);
    return OK;
}
#endif
