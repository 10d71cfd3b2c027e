/* MUMPS on recorded systems, set up as Ipopt sets it up: built by scripts/bench-kkt.sh. */
#include <stdlib.h>
#include <string.h>

#include "dmumps_c.h"

/* Entries are counted from 1. `ordering` is Ipopt's option mumps_pivot_order. */
void *mumps_new(int n, int entries, int *rows, int *columns, int ordering)
{
    DMUMPS_STRUC_C *id = calloc(1, sizeof *id);
    id->job = -1;
    id->par = 1;
    id->sym = 2;
    id->comm_fortran = -987654;
    dmumps_c(id);
    for (int stream = 0; stream < 3; stream++) id->icntl[stream] = 0;
    id->icntl[3] = 0;
    id->icntl[5] = 7;         /* mumps_permuting_scaling */
    id->icntl[6] = ordering;  /* mumps_pivot_order */
    id->icntl[7] = 77;        /* mumps_scaling */
    id->icntl[9] = 0;         /* no refinement of its own */
    id->icntl[12] = 1;        /* the root in one process, for the inertia */
    id->icntl[13] = 1000;     /* mumps_mem_percent */
    id->cntl[0] = 1e-6;       /* mumps_pivtol */
    id->n = n;
    id->nz = entries;
    id->irn = rows;
    id->jcn = columns;
    return id;
}

static int run(DMUMPS_STRUC_C *id, int job)
{
    id->job = job;
    dmumps_c(id);
    return id->infog[0];
}

int mumps_analyse(void *id, double *values)
{
    ((DMUMPS_STRUC_C *)id)->a = values;
    return run(id, 1);
}

/* Negative pivots, or -1. */
int mumps_factor(void *id, double *values)
{
    DMUMPS_STRUC_C *mumps = id;
    mumps->a = values;
    return run(mumps, 2) < 0 ? -1 : mumps->infog[11];
}

int mumps_solve(void *id, double *x)
{
    ((DMUMPS_STRUC_C *)id)->rhs = x;
    return run(id, 3);
}

void mumps_free(void *id)
{
    run(id, -2);
    free(id);
}
