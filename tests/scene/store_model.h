/* SPDX-License-Identifier: MIT
 *
 * What a store should hold after so many steps, without a store: the same for whatever form of it.
 */
#ifndef TESTS_SCENE_STORE_MODEL_H
#define TESTS_SCENE_STORE_MODEL_H

#include <cubemap/store.h>

enum
{
    MODEL_KEYS = 40,
    MODEL_KIND = 7
};

/* Which blob each key has, by its seed; 0: none. */
typedef struct store_model
{
    unsigned seed[MODEL_KEYS];
} store_model;

/* The key of a number: keys are of different lengths, and have bytes of any value. */
cm_store_key model_key(unsigned number, unsigned char bytes[CM_STORE_KEY_MAX]);

/* What a step does, one that ends with a commit: some keys get blobs, some lose them. */
void model_step(store_model *model, unsigned step);
/* The same to a store, without the commit: the status of what failed first. */
cm_status model_step_store(cm_store *store, unsigned step);

/* Has the store what the model has, all of it and nothing else? "" if it has, else what differs. */
const char *model_differs(const store_model *model, cm_store *store);

#endif
