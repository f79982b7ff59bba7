/*
 * swc.h - neurons in SWC: a frustum or a rounded cone from each node to its
 * parent
 */
#ifndef CYLINT_SWC_H
#define CYLINT_SWC_H

struct scene;

/* What the nodes become: frusta, or rounded cones and a sphere at each root. */
enum swc_form { SWC_CONES, SWC_ROUND };

extern const char *const swc_forms[]; /* their words, then NULL */

/* Whether a file is SWC: its name ends in .swc or .SWC. */
int swc_is_name(const char *file);

/* Reads all nodes and adds their shapes to the scene.  ends: of these, or
 * NOT_GIVEN.  Returns 0, or an exit status after a message. */
int swc_read(struct scene *scene, const char *file, int ends,
             enum swc_form form);

#endif
