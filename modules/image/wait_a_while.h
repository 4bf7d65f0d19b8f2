/* SPDX-License-Identifier: MIT
 *
 * For threads that need what another one makes.
 */
#ifndef MODULES_IMAGE_WAIT_A_WHILE_H
#define MODULES_IMAGE_WAIT_A_WHILE_H

/* Another thread does something, which takes long. */
void cm_wait_a_while(void);

#endif
