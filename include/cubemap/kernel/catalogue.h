/* SPDX-License-Identifier: MIT
 *
 * The catalogue: one line a mapping. Each room holds the mapping's kernel and, under CM_DESCRIPTORS,
 * its descriptor; this list makes the kernels, the descriptors and the tables of the library.
 */
#include "gnomonic.h"
#include "tangent.h"
#include "outerra.h"
#include "cobe.h"
#include "qsc.h"
#include "nowell.h"
#include "continuous.h"
#include "unicube.h"
#include "everitt.h"
#include "algebraic.h"
#include "coupled.h"
#include "tanh.h"
#include "logistic.h"
#include "smoothstep.h"
#include "s2.h"
#include "healpix.h"
