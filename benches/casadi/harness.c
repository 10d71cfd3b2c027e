/* Times the three functions that CasADi generated and prints their values, dense, as JSON. */
#include "node.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef int (*function)(const double **, double **, casadi_int *, double *, int);

enum { BATCH = 200, BATCHES = 101 };

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

static double median_time(function f, const double **arg, double **res, casadi_int *iw, double *w) {
    static double times[BATCHES];
    for (int b = 0; b < BATCHES; b++) {
        double start = now();
        for (int i = 0; i < BATCH; i++) f(arg, res, iw, w, 0);
        times[b] = (now() - start) / BATCH;
    }
    qsort(times, BATCHES, sizeof *times, ascending);
    return times[BATCHES / 2];
}

/* Nonzeros by columns in a list of rows. */
static void print_dense(const char *name, const casadi_int *sparsity, const double *nonzeros) {
    casadi_int rows = sparsity[0], columns = sparsity[1];
    const casadi_int *start = sparsity + 2, *row = sparsity + 3 + columns;
    double *dense = calloc((size_t)(rows * columns), sizeof *dense);
    for (casadi_int c = 0; c < columns; c++)
        for (casadi_int k = start[c]; k < start[c + 1]; k++) dense[row[k] * columns + c] = nonzeros[k];
    printf("\"%s\": [", name);
    for (casadi_int i = 0; i < rows * columns; i++) printf("%s%.17g", i ? ", " : "", dense[i]);
    printf("], ");
    free(dense);
}

int main(void) {
    static double z[256], weights[256], values[256], jacobian[65536], hessian[65536];
    casadi_int inputs = node_hessian_sparsity_in(0)[0], outputs = node_hessian_sparsity_in(1)[0];
    for (casadi_int i = 0; i < inputs; i++)
        if (scanf("%lf", &z[i]) != 1) return 1;
    for (casadi_int i = 0; i < outputs; i++)
        if (scanf("%lf", &weights[i]) != 1) return 1;
    casadi_int sizes[4], iw_size = 0, w_size = 0;
    int (*work[])(casadi_int *, casadi_int *, casadi_int *, casadi_int *) = {node_values_work, node_jacobian_work, node_hessian_work};
    for (int k = 0; k < 3; k++) {
        work[k](&sizes[0], &sizes[1], &sizes[2], &sizes[3]);
        if (sizes[2] > iw_size) iw_size = sizes[2];
        if (sizes[3] > w_size) w_size = sizes[3];
    }
    casadi_int *iw = malloc((size_t)(iw_size + 1) * sizeof *iw);
    double *w = malloc((size_t)(w_size + 1) * sizeof *w);
    const double *arg[16] = {z, weights};
    double *res[16] = {values};
    double t_values = median_time(node_values, arg, res, iw, w);
    res[0] = jacobian;
    double t_jacobian = median_time(node_jacobian, arg, res, iw, w);
    res[0] = hessian;
    double t_hessian = median_time(node_hessian, arg, res, iw, w);
    printf("{");
    printf("\"values\": [");
    for (casadi_int i = 0; i < outputs; i++) printf("%s%.17g", i ? ", " : "", values[i]);
    printf("], ");
    print_dense("jacobian", node_jacobian_sparsity_out(0), jacobian);
    print_dense("hessian", node_hessian_sparsity_out(0), hessian);
    printf("\"time\": {\"values\": %.6f, \"jacobian\": %.6f, \"hessian\": %.6f}}\n", t_values, t_jacobian, t_hessian);
    return 0;
}
