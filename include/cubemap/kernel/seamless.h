/* SPDX-License-Identifier: MIT
 *
 * seamless: exactly equal-area and without a crease, twice continuously differentiable on a face.
 * docs/guide/new-mappings.md derives it: on the octant 0 <= q <= p, with a function S(p, v),
 *     S_p(p, v) = the derivative by p of the area between the lines 0, p and 0, q,   u = S_v(p, v),
 *     S = d^2 (alpha x + beta x^5 + gamma x^7),   x = v / d,
 *     d = p M(p^2), which is v on the diagonal.
 *
 * alpha, beta and gamma are functions of X = p^2 alone. What is left of the arc tangent in them is small and
 * smooth, so that beta and gamma, and what S_p needs, are polynomials here, times what vanishes at the centre
 * and on the edge; research/elementary/seamless derives them. Either direction is Newton's method in one
 * unknown, for a small number that vanishes where u = p and v = q or where u = v: forward
 * x = t (1 + delta) with t = q / p, inverse p = u (1 + epsilon). In quadruple precision the functions
 * are those of the page.
 */
#ifdef CM_DESCRIPTORS
/* clang-format off */
CM_WARP(seamless,
        .identifier = "seamless",
        .aliases = "",
        .name = "equal-area without a crease",
        .source = "libcubemap 2026, docs/guide/new-mappings.md",
        .family = CM_FAMILY_BIVARIATE,
        .properties = CM_EQUAL_AREA,
        .smooth_face = CM_SMOOTH_C2,
        .smooth_edge = CM_SMOOTH_C0,
        .smooth_corner = CM_SMOOTH_C2,
        .bounds = {.round_trip = 2.7, .plane_round_trip = 4, .forward = 2, .inverse = 3,
                   .relative = 6},
        .fast = CM_FAST_FORWARD | CM_FAST_INVERSE)
/* clang-format on */
#else

CM_FN CM_NAME(cm_constants) CM_NAME(cm_seamless_prepare)(CM_NAME(cm_constants) k)
{
    return k;
}

#define CM_SEAMLESS_A CM_LIT(1.381976597885341917060978584127558732558)   /* sqrt(6 / pi) */
#define CM_SEAMLESS_A1 CM_LIT(0.3819765978853419170609785841275587325575) /* a - 1 */
#define CM_SEAMLESS_B CM_LIT(-0.5670837769349163246707229691234751275479)
#define CM_SEAMLESS_C CM_LIT(0.1851071790495744076097443849959163949904)
#define CM_SEAMLESS_AREA CM_LIT(1.909859317102744029226605160470172344414) /* 6 / pi */

/* M - 1, with edge = 1 - X */
CM_FN CM_REAL CM_NAME(cm_seamless_stretch)(CM_REAL x, CM_REAL edge)
{
    return edge * cm_mad(-x, CM_SEAMLESS_C, CM_SEAMLESS_A1);
}

/* G, the derivative of d */
CM_FN CM_REAL CM_NAME(cm_seamless_rise)(CM_REAL x)
{
    return cm_mad(x, cm_mad(x, CM_LIT(5.0) * CM_SEAMLESS_C, CM_LIT(3.0) * CM_SEAMLESS_B),
                  CM_SEAMLESS_A);
}

/* The factors of x^5 and x^7, and their derivatives by log p. */
CM_STRUCT(cm_seamless_pair)
{
    CM_REAL five;
    CM_REAL seven;
    CM_REAL five_slope;
    CM_REAL seven_slope;
}
CM_STRUCT_END(cm_seamless_pair)

#if CM_REAL_BITS <= 64

/* A polynomial and its derivative. */
CM_STRUCT(cm_seamless_value)
{
    CM_REAL value;
    CM_REAL slope;
}
CM_STRUCT_END(cm_seamless_value)

CM_FN CM_NAME(cm_seamless_value)
    CM_NAME(cm_seamless_first)(CM_REAL z, CM_REAL second, CM_REAL first)
{
    CM_NAME(cm_seamless_value) r;
    r.value = cm_mad(z, second, first);
    r.slope = second;
    return r;
}

CM_FN CM_NAME(cm_seamless_value)
    CM_NAME(cm_seamless_next)(CM_NAME(cm_seamless_value) r, CM_REAL z, CM_REAL coefficient)
{
    r.slope = cm_mad(r.slope, z, r.value);
    r.value = cm_mad(r.value, z, coefficient);
    return r;
}

/* From those in s^2 of the even and the odd coefficients. */
CM_FN CM_NAME(cm_seamless_value)
    CM_NAME(cm_seamless_join)(CM_REAL s, CM_NAME(cm_seamless_value) even,
                              CM_NAME(cm_seamless_value) odd)
{
    CM_REAL s2 = CM_LIT(2.0) * s;
    CM_NAME(cm_seamless_value) r;
    r.value = cm_mad(s, odd.value, even.value);
    r.slope = cm_mad(s2, cm_mad(s, odd.slope, even.slope), odd.value);
    return r;
}

/* beta over X (1 - X), of X - 1/2; in double to 1e-11 only */
CM_FN CM_NAME(cm_seamless_value) CM_NAME(cm_seamless_rough_beta)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_NAME(cm_seamless_value) even;
    CM_NAME(cm_seamless_value) odd;
#if CM_REAL_BITS == 64
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(4.4702441173593108e-2),
                                      CM_LIT(-5.2081332550192372e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(5.2643815688566638e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(6.0690558223565260e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.5467990765640635e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-2.5905601580725256e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(2.0470148267367910e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(5.3584908620098008e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.2916554980453946e-2),
                                     CM_LIT(-1.4724550891326181e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-3.2118126729723313e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(5.0691541637047949e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-3.6713754723208189e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(4.0132657144368224e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-5.4226529936895106e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.8245837677122085e-2));
#else
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(3.02835442e-2), CM_LIT(1.05786417e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.98565410e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-2.58872081e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(2.04699226e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(5.35849072e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(2.27939766e-2), CM_LIT(-2.92186905e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.16581386e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-5.41880652e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.82453538e-2));
#endif
    return CM_NAME(cm_seamless_join)(s, even, odd);
}

/* gamma over X (1 - X), likewise */
CM_FN CM_NAME(cm_seamless_value) CM_NAME(cm_seamless_rough_gamma)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_NAME(cm_seamless_value) even;
    CM_NAME(cm_seamless_value) odd;
#if CM_REAL_BITS == 64
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(-2.6014306345715946e-2),
                                      CM_LIT(3.5379004148817089e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.2670451151281837e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-1.3239009611514443e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(5.8405147470293427e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(2.3107718449461127e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-7.1448314248326759e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.2598683074397020e-2));
    odd =
        CM_NAME(cm_seamless_first)(z, CM_LIT(5.0935400755194272e-3), CM_LIT(9.2396231274162657e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(1.9221932345265411e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-3.6179184864563362e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(2.1281511754979138e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-6.9245233638462961e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.1396884742407795e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.3502006817690252e-2));
#else
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.61719974e-2), CM_LIT(-4.81973495e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(6.19122386e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(2.30927598e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-7.14464765e-3));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.25986817e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.96378641e-2), CM_LIT(1.68578792e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-6.42559491e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.13742682e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.35017236e-2));
#endif
    return CM_NAME(cm_seamless_join)(s, even, odd);
}

#if CM_REAL_BITS == 64

/* beta over X (1 - X) */
CM_FN CM_REAL CM_NAME(cm_seamless_beta)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_REAL even = cm_mad(z, CM_LIT(3.0947580490379635e-2), CM_LIT(-4.2868466943873900e-3));
    even = cm_mad(z, even, CM_LIT(-1.2753826160635790e-2));
    even = cm_mad(z, even, CM_LIT(3.7482597228851333e-2));
    even = cm_mad(z, even, CM_LIT(-6.4929559565064235e-3));
    even = cm_mad(z, even, CM_LIT(3.1696135423148177e-2));
    even = cm_mad(z, even, CM_LIT(-4.4321996319849649e-2));
    even = cm_mad(z, even, CM_LIT(5.0752964642761272e-2));
    even = cm_mad(z, even, CM_LIT(6.3071491034526576e-3));
    even = cm_mad(z, even, CM_LIT(-3.5625855398817192e-3));
    even = cm_mad(z, even, CM_LIT(-2.5905096389622413e-2));
    even = cm_mad(z, even, CM_LIT(2.0470142180484468e-2));
    even = cm_mad(z, even, CM_LIT(5.3584908632014316e-2));
    CM_REAL odd = cm_mad(z, CM_LIT(-3.4037847314625391e-2), CM_LIT(3.6553530284581387e-2));
    odd = cm_mad(z, odd, CM_LIT(-4.7909821997068953e-2));
    odd = cm_mad(z, odd, CM_LIT(7.4036415933657401e-3));
    odd = cm_mad(z, odd, CM_LIT(-5.1796946735291460e-3));
    odd = cm_mad(z, odd, CM_LIT(-1.6695987457238943e-3));
    odd = cm_mad(z, odd, CM_LIT(-2.0716144097878794e-2));
    odd = cm_mad(z, odd, CM_LIT(-3.0670196936883661e-2));
    odd = cm_mad(z, odd, CM_LIT(5.0508447440898226e-2));
    odd = cm_mad(z, odd, CM_LIT(-3.6701552586596728e-2));
    odd = cm_mad(z, odd, CM_LIT(4.0128737276351138e-3));
    odd = cm_mad(z, odd, CM_LIT(-5.4226525203866498e-2));
    odd = cm_mad(z, odd, CM_LIT(3.8245837667852334e-2));
    return cm_mad(s, odd, even);
}

/* gamma over X (1 - X) */
CM_FN CM_REAL CM_NAME(cm_seamless_gamma)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_REAL even = cm_mad(z, CM_LIT(-1.6778245305939608e-2), CM_LIT(8.4751089783436360e-4));
    even = cm_mad(z, even, CM_LIT(1.0819163963670383e-2));
    even = cm_mad(z, even, CM_LIT(-2.4289056343132002e-2));
    even = cm_mad(z, even, CM_LIT(5.6661550521279165e-3));
    even = cm_mad(z, even, CM_LIT(-1.9661089821639135e-2));
    even = cm_mad(z, even, CM_LIT(3.1316143457433256e-2));
    even = cm_mad(z, even, CM_LIT(-3.1664350523110889e-2));
    even = cm_mad(z, even, CM_LIT(-1.4513975705553617e-3));
    even = cm_mad(z, even, CM_LIT(5.8489945181390765e-3));
    even = cm_mad(z, even, CM_LIT(2.3107446643341682e-2));
    even = cm_mad(z, even, CM_LIT(-7.1448281473856547e-3));
    even = cm_mad(z, even, CM_LIT(-3.2598683080814247e-2));
    CM_REAL odd = cm_mad(z, CM_LIT(1.9014440583538850e-2), CM_LIT(-2.2437371937147919e-2));
    odd = cm_mad(z, odd, CM_LIT(2.9739118593110059e-2));
    odd = cm_mad(z, odd, CM_LIT(-5.5817648367598154e-3));
    odd = cm_mad(z, odd, CM_LIT(2.2080738561666056e-3));
    odd = cm_mad(z, odd, CM_LIT(-2.4086989718388139e-4));
    odd = cm_mad(z, odd, CM_LIT(1.2196856201068517e-2));
    odd = cm_mad(z, odd, CM_LIT(1.8494515626360172e-2));
    odd = cm_mad(z, odd, CM_LIT(-3.6086324971679205e-2));
    odd = cm_mad(z, odd, CM_LIT(2.1275289000288623e-2));
    odd = cm_mad(z, odd, CM_LIT(-6.9243228204559698e-3));
    odd = cm_mad(z, odd, CM_LIT(3.1396882317045745e-2));
    odd = cm_mad(z, odd, CM_LIT(-4.3502006812938636e-2));
    return cm_mad(s, odd, even);
}

#endif

/* C5 over X (C1 + C5 + C7) */
CM_FN CM_NAME(cm_seamless_value) CM_NAME(cm_seamless_c5)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_NAME(cm_seamless_value) even;
    CM_NAME(cm_seamless_value) odd;
#if CM_REAL_BITS == 64
    even =
        CM_NAME(cm_seamless_first)(z, CM_LIT(2.4067851740350063e-1), CM_LIT(7.3019280459832678e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-1.5944020767681550));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(3.0423723994607319));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-2.0024366911818712));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(4.3078458720949170e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-5.0393374084591214e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.4003293898281610));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.0741212422904350e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-1.8355809183655838));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.3109671580964670));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-9.4424245351326735e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(6.4326198354334096e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-5.6103938363010231e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-5.0116165001897292e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(2.8019095575527347e-1),
                                     CM_LIT(-1.5165806836150600e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-7.4573043122885496e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.1521370019346662e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(1.5161880503477181));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-2.4749743830679987));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(1.2374001363901479));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-1.1462704507333792));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(2.5106355848687443));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-2.7785949655119588));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(7.5423775002764926e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-8.1848412248782705e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(8.3757518740566816e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.2446465353190505e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-1.5366308098008608e-1));
#else
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(1.10061562), CM_LIT(-2.14957428));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.36216116));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-9.87882987e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(6.43441021e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-5.61042130e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-5.01161590e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(1.71014273), CM_LIT(-2.50923252));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(7.08109796e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.11995826e-3));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(8.37404907e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.24461991e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-1.53663084e-1));
#endif
    return CM_NAME(cm_seamless_join)(s, even, odd);
}

/* C7 over X (C1 + C5 + C7) */
CM_FN CM_NAME(cm_seamless_value) CM_NAME(cm_seamless_c7)(CM_REAL s)
{
    CM_REAL z = s * s;
    CM_NAME(cm_seamless_value) even;
    CM_NAME(cm_seamless_value) odd;
#if CM_REAL_BITS == 64
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.5455095601660307e-1),
                                      CM_LIT(-5.4806698699520991e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.0833276952043982));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-2.0345344036412722));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.3456739215020805));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-3.0068470774514761e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(4.0327327660509965e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-9.7398406998514220e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-2.7874669759057790e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.1977776409839291));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-7.7776321358162026e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(1.7733187226263759e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-4.4137504863106153e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(3.8578130077530165e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(4.7376643565810415e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.8606061605500512e-1),
                                     CM_LIT(7.7428153256150004e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(5.2854174362163264e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-2.4258372068764453e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-9.9235524895257554e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(1.6007852627633885));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-7.9154252962015437e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(7.4147963282029461e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-1.7036352981595031));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(1.8348145328650027));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-5.1517431876369257e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(4.8143994840086822e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-6.6634470750152730e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.3828338530615953e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(9.6432766443438470e-2));
#else
    even = CM_NAME(cm_seamless_first)(z, CM_LIT(-6.95971191e-1), CM_LIT(1.40593374));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-8.11432540e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(2.05897894e-2));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(-4.41491932e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(3.85783106e-1));
    even = CM_NAME(cm_seamless_next)(even, z, CM_LIT(4.73766401e-2));
    odd = CM_NAME(cm_seamless_first)(z, CM_LIT(-1.18317723), CM_LIT(1.65950203));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-4.85148042e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(4.54981625e-2));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(-6.66233897e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(3.38281661e-1));
    odd = CM_NAME(cm_seamless_next)(odd, z, CM_LIT(9.64327678e-2));
#endif
    return CM_NAME(cm_seamless_join)(s, even, odd);
}

/* beta and gamma, good enough for slopes, and for a first step */
CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_rough)(CM_REAL x, CM_REAL edge)
{
    CM_REAL s = x - CM_LIT(0.5);
    CM_NAME(cm_seamless_value) beta = CM_NAME(cm_seamless_rough_beta)(s);
    CM_NAME(cm_seamless_value) gamma = CM_NAME(cm_seamless_rough_gamma)(s);
    CM_REAL inner = x * edge;
    CM_REAL x2 = CM_LIT(2.0) * x;
    CM_REAL lean = edge - x;
    CM_NAME(cm_seamless_pair) r;
    r.five = inner * beta.value;
    r.seven = inner * gamma.value;
    r.five_slope = x2 * cm_mad(inner, beta.slope, lean * beta.value);
    r.seven_slope = x2 * cm_mad(inner, gamma.slope, lean * gamma.value);
    return r;
}

/* beta and gamma */
CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_bend)(CM_REAL x, CM_REAL edge)
{
    CM_NAME(cm_seamless_pair) r = CM_NAME(cm_seamless_rough)(x, edge);
#if CM_REAL_BITS == 64
    CM_REAL s = x - CM_LIT(0.5);
    CM_REAL inner = x * edge;
    r.five = inner * CM_NAME(cm_seamless_beta)(s);
    r.seven = inner * CM_NAME(cm_seamless_gamma)(s);
#endif
    return r;
}

/* C5 and C7 over C1 + C5 + C7 */
CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_lead)(CM_REAL x)
{
    CM_REAL s = x - CM_LIT(0.5);
    CM_NAME(cm_seamless_value) c5 = CM_NAME(cm_seamless_c5)(s);
    CM_NAME(cm_seamless_value) c7 = CM_NAME(cm_seamless_c7)(s);
    CM_REAL x2 = CM_LIT(2.0) * x;
    CM_NAME(cm_seamless_pair) r;
    r.five = x * c5.value;
    r.seven = x * c7.value;
    r.five_slope = x2 * cm_mad(x, c5.slope, c5.value);
    r.seven_slope = x2 * cm_mad(x, c7.slope, c7.value);
    return r;
}

#else /* the definition */

/* r and mu of the page, and their first and second derivatives by log p, as those of all else here;
 * whole is C1 + C5 + C7. */
CM_STRUCT(cm_seamless_series)
{
    CM_REAL r;
    CM_REAL r1;
    CM_REAL r2;
    CM_REAL mu;
    CM_REAL mu1;
    CM_REAL mu2;
    CM_REAL rate; /* G / M */
    CM_REAL rate1;
    CM_REAL whole;
    CM_REAL whole1; /* of its logarithm */
}
CM_STRUCT_END(cm_seamless_series)

CM_FN CM_NAME(cm_seamless_series) CM_NAME(cm_seamless_define)(CM_REAL x)
{
    CM_REAL m = CM_LIT(1.0) + CM_NAME(cm_seamless_stretch)(x, CM_LIT(1.0) - x);
    CM_REAL g = CM_NAME(cm_seamless_rise)(x);
    CM_REAL g1 = x * (CM_LIT(6.0) * CM_SEAMLESS_B + x * (CM_LIT(20.0) * CM_SEAMLESS_C));
    CM_REAL g2 = x * (CM_LIT(12.0) * CM_SEAMLESS_B + x * (CM_LIT(80.0) * CM_SEAMLESS_C));
    CM_REAL w = CM_LIT(1.0) + x;
    CM_REAL omega = CM_LIT(1.0) + CM_LIT(2.0) * x;
    CM_REAL root = cm_sqrt(omega);
    CM_NAME(cm_seamless_series) s;
    s.rate = g / m;
    s.rate1 = g1 / m - s.rate * (s.rate - CM_LIT(1.0));
    s.whole = CM_SEAMLESS_AREA / (m * m * w * root);
    s.whole1 =
        -(CM_LIT(2.0) * (s.rate - CM_LIT(1.0)) + CM_LIT(2.0) * x / w + CM_LIT(2.0) * x / omega);
    s.r =
        CM_SEAMLESS_AREA * (CM_LIT(1.0) + CM_NAME(cm_atan_excess)(x * x / omega)) / (root * m * m);
    s.r1 = CM_LIT(2.0) * (s.whole - s.rate * s.r);
    s.r2 = CM_LIT(2.0) * (s.whole * s.whole1 - s.rate1 * s.r - s.rate * s.r1);
    CM_REAL rho = CM_SEAMLESS_AREA / (omega * root);
    CM_REAL rho1 = -(CM_LIT(6.0) * x * rho / omega);
    CM_REAL plus = g * g + rho;
    CM_REAL plus1 = CM_LIT(2.0) * g * g1 + rho1;
    CM_REAL turn = g1 + CM_LIT(3.0) * x * g / omega;
    CM_REAL turn1 =
        g2 + CM_LIT(3.0) * x * (CM_LIT(2.0) * g + g1 - CM_LIT(4.0) * x * g / omega) / omega;
    s.mu = (g * g - rho) / plus;
    s.mu1 = CM_LIT(4.0) * g * rho * turn / (plus * plus);
    s.mu2 = CM_LIT(4.0) * (rho1 * g * turn + rho * g1 * turn + rho * g * turn1) / (plus * plus) -
            CM_LIT(2.0) * s.mu1 * plus1 / plus;
    return s;
}

/* beta and gamma from (1 - r) / 2 and mu, or from what is derived from these */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_seamless_parts)(CM_REAL h, CM_REAL mu)
{
    CM_REAL gamma = (mu - CM_LIT(5.0) * h) / CM_LIT(12.0);
    return CM_NAME(cm_make_uv)((h - CM_LIT(6.0) * gamma) / CM_LIT(4.0), gamma);
}

CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_bend)(CM_REAL x, CM_REAL edge)
{
    CM_UNUSED(edge);
    CM_NAME(cm_seamless_series) s = CM_NAME(cm_seamless_define)(x);
    CM_NAME(cm_uv) part = CM_NAME(cm_seamless_parts)(CM_LIT(0.5) * (CM_LIT(1.0) - s.r), s.mu);
    CM_NAME(cm_uv) part1 = CM_NAME(cm_seamless_parts)(CM_LIT(-0.5) * s.r1, s.mu1);
    CM_NAME(cm_seamless_pair) r;
    r.five = part.u;
    r.seven = part.v;
    r.five_slope = part1.u;
    r.seven_slope = part1.v;
    return r;
}

CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_rough)(CM_REAL x, CM_REAL edge)
{
    return CM_NAME(cm_seamless_bend)(x, edge);
}

CM_FN CM_NAME(cm_seamless_pair) CM_NAME(cm_seamless_lead)(CM_REAL x)
{
    CM_NAME(cm_seamless_series) s = CM_NAME(cm_seamless_define)(x);
    CM_NAME(cm_uv) part = CM_NAME(cm_seamless_parts)(CM_LIT(0.5) * (CM_LIT(1.0) - s.r), s.mu);
    CM_NAME(cm_uv) part1 = CM_NAME(cm_seamless_parts)(CM_LIT(-0.5) * s.r1, s.mu1);
    CM_NAME(cm_uv) part2 = CM_NAME(cm_seamless_parts)(CM_LIT(-0.5) * s.r2, s.mu2);
    CM_REAL rate3 = CM_LIT(3.0) * s.rate;
    CM_REAL rate5 = CM_LIT(5.0) * s.rate;
    CM_NAME(cm_seamless_pair) r;
    r.five = (part1.u - rate3 * part.u) / s.whole;
    r.seven = (part1.v - rate5 * part.v) / s.whole;
    r.five_slope =
        (part2.u - rate3 * part1.u - CM_LIT(3.0) * s.rate1 * part.u) / s.whole - r.five * s.whole1;
    r.seven_slope =
        (part2.v - rate5 * part1.v - CM_LIT(5.0) * s.rate1 * part.v) / s.whole - r.seven * s.whole1;
    return r;
}

#endif

/* five (1 - x^4) + seven (1 - x^6), which vanishes on the diagonal, x = 1 */
CM_FN CM_REAL CM_NAME(cm_seamless_lack)(CM_REAL x, CM_REAL five, CM_REAL seven)
{
    CM_REAL x2 = x * x;
    CM_REAL both = five + seven;
    return ((CM_LIT(1.0) - x) * (CM_LIT(1.0) + x)) * cm_mad(x2 * x2, seven, cm_mad(x2, both, both));
}

/* One step of third order, for C1 (1 + delta) + C5 t^4 (1 + delta)^5 + C7 t^6 (1 + delta)^7, less its
 * value at delta = 0, to be rest; five and seven are C5 t^4 and C7 t^6, one is C1. */
CM_FN CM_REAL CM_NAME(cm_seamless_forward_step)(CM_REAL delta, CM_REAL rest, CM_REAL one,
                                                CM_REAL five, CM_REAL seven)
{
    CM_REAL f = CM_LIT(1.0) + delta;
    CM_REAL f2 = f * f;
    CM_REAL f3 = f2 * f;
    CM_REAL f4 = f2 * f2;
    CM_REAL sum = f2 + (f + CM_LIT(1.0));
    /* ((1 + delta)^5 - 1) / delta, and of the seventh power */
    CM_REAL power5 = cm_mad(f2, sum, f + CM_LIT(1.0));
    CM_REAL power7 = cm_mad(f4, sum, sum) + f3;
    CM_REAL left = rest - delta * cm_mad(five, power5, cm_mad(seven, power7, one));
    CM_REAL slope = cm_mad(f4, cm_mad(f2, CM_LIT(7.0) * seven, CM_LIT(5.0) * five), one);
    CM_REAL curve = f3 * cm_mad(f2, CM_LIT(21.0) * seven, CM_LIT(10.0) * five);
    CM_REAL inverse = CM_NAME(cm_quotient)(CM_LIT(1.0), slope);
    CM_REAL step = left * inverse;
    return cm_mad(step, cm_mad(-step, curve * inverse, CM_LIT(1.0)), delta);
}

/* delta, within 1.2e-3 */
CM_FN CM_REAL CM_NAME(cm_seamless_forward_start)(CM_REAL x, CM_REAL y, CM_REAL factor)
{
    CM_REAL row0 = cm_mad(
        x,
        cm_mad(x, cm_mad(x, CM_LIT(9.19802720e-3), CM_LIT(-1.80241736e-2)), CM_LIT(-3.10201487e-1)),
        CM_LIT(4.65388952e-1));
    CM_REAL row1 =
        cm_mad(x, cm_mad(x, CM_LIT(1.09323843e-1), CM_LIT(-2.29703988e-1)), CM_LIT(-4.98352306e-4));
    CM_REAL row2 = cm_mad(x, CM_LIT(2.72930619e-1), CM_LIT(3.10756648e-2));
    CM_REAL row3 = CM_LIT(-1.10619413e-1);
    return factor * cm_mad(y, cm_mad(y, cm_mad(y, row3, row2), row1), row0);
}

/* With w = 1 + X + q^2 and omega = 1 + 2 X, S_p = what is wanted says
 *     C1 x + C5 x^5 + C7 x^7 = t sqrt(omega / w)
 * in units of C1 + C5 + C7. Its difference at delta = 0 is a multiple of X (1 - t^2). */
CM_FN CM_NAME(cm_uv) CM_NAME(cm_seamless_forward)(CM_REAL p, CM_REAL q, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_REAL t2 = t * t;
    CM_REAL t4 = t2 * t2;
    CM_REAL x = major * major;
    CM_REAL edge = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major);
    CM_REAL beside = (CM_LIT(1.0) - t) * (CM_LIT(1.0) + t);
    CM_NAME(cm_seamless_pair) lead = CM_NAME(cm_seamless_lead)(x);
    CM_REAL w = (CM_LIT(1.0) + x) + minor * minor;
    CM_REAL mean = CM_NAME(cm_root)(w * cm_mad(CM_LIT(2.0), x, CM_LIT(1.0)));
    CM_REAL sum = cm_mad(t2, lead.five + lead.seven, lead.five + lead.seven);
    CM_REAL rest = beside * (cm_mad(t4, lead.seven, sum) + CM_NAME(cm_quotient)(x, w + mean));
    CM_REAL one = (CM_LIT(1.0) - lead.five) - lead.seven;
    CM_REAL five = lead.five * t4;
    CM_REAL seven = lead.seven * (t4 * t2);
    CM_REAL delta = CM_NAME(cm_seamless_forward_start)(x, t2, x * beside);
    delta = CM_NAME(cm_seamless_forward_step)(delta, rest, one, five, seven);
#if CM_REAL_BITS >= 64
    delta = CM_NAME(cm_seamless_forward_step)(delta, rest, one, five, seven);
#endif
#if CM_REAL_BITS > 64
    delta = CM_NAME(cm_seamless_forward_step)(delta, rest, one, five, seven);
#endif
    CM_NAME(cm_seamless_pair) bend = CM_NAME(cm_seamless_bend)(x, edge);
    CM_REAL lack = CM_NAME(cm_seamless_lack)(cm_mad(t, delta, t), CM_LIT(5.0) * bend.five,
                                             CM_LIT(7.0) * bend.seven);
    /* u = p M (1 - lack), v = q M (1 + delta) */
    CM_REAL m = CM_NAME(cm_seamless_stretch)(x, edge);
    CM_REAL u = CM_NAME(cm_stretch)(major, cm_mad(-lack, m, m - lack));
    CM_REAL v = CM_NAME(cm_stretch)(minor, cm_mad(delta, m, m + delta));
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(wide, u, v), p),
                               cm_copysign(CM_SELECT(wide, v, u), q));
}

/* p, and p / u - 1, to be more accurate than p where p is small. */
CM_STRUCT(cm_seamless_place)
{
    CM_REAL p;
    CM_REAL excess;
}
CM_STRUCT_END(cm_seamless_place)

/* One Newton step for u, with y = v / u; bend is of p^2, square. */
CM_FN CM_NAME(cm_seamless_place)
    CM_NAME(cm_seamless_inverse_step)(CM_NAME(cm_seamless_place) r, CM_REAL u, CM_REAL y,
                                      CM_REAL square, CM_REAL edge, CM_NAME(cm_seamless_pair) bend)
{
    CM_REAL five = CM_LIT(5.0) * bend.five;
    CM_REAL seven = CM_LIT(7.0) * bend.seven;
    CM_REAL m = CM_NAME(cm_seamless_stretch)(square, edge);
    CM_REAL m1 = CM_LIT(1.0) + m;
    CM_REAL x = CM_NAME(cm_quotient)(y, cm_mad(r.excess, m1, m1));
    CM_REAL x2 = x * x;
    CM_REAL lack = CM_NAME(cm_seamless_lack)(x, five, seven);
    CM_REAL lack_slope =
        CM_NAME(cm_seamless_lack)(x, CM_LIT(5.0) * bend.five_slope, CM_LIT(7.0) * bend.seven_slope);
    CM_REAL turn = (x2 * x2) * cm_mad(x2, CM_LIT(6.0) * seven, CM_LIT(4.0) * five);
    CM_REAL slope =
        cm_mad(CM_NAME(cm_seamless_rise)(square), (CM_LIT(1.0) - lack) - turn, -(m1 * lack_slope));
    CM_REAL inverse = CM_NAME(cm_quotient)(CM_LIT(1.0), slope);
    CM_REAL made = cm_mad(-lack, m, m - lack); /* what p gives is p (1 + made) */
    r.excess = cm_mad(-cm_mad(r.excess, made, r.excess + made), inverse, r.excess);
    r.p = cm_mad(-cm_mad(r.p, made, r.p - u), inverse, r.p);
    return r;
}

/* Within 7e-5. First d, which is near u, then p from d alone. */
CM_FN CM_NAME(cm_seamless_place) CM_NAME(cm_seamless_inverse_start)(CM_REAL u, CM_REAL y)
{
    CM_REAL x = u * u;
    CM_REAL z = y * y;
    CM_REAL row0 =
        cm_mad(x,
               cm_mad(x,
                      cm_mad(x,
                             cm_mad(x, cm_mad(x, CM_LIT(-1.53629566e-1), CM_LIT(3.95942211e-1)),
                                    CM_LIT(-4.69426729e-1)),
                             CM_LIT(1.89159279e-1)),
                      CM_LIT(-4.04459549e-2)),
               CM_LIT(6.52363148e-2));
    CM_REAL row1 = cm_mad(x,
                          cm_mad(x,
                                 cm_mad(x, cm_mad(x, CM_LIT(-9.32494041e-1), CM_LIT(1.83121696)),
                                        CM_LIT(-1.20739599)),
                                 CM_LIT(2.23938405e-1)),
                          CM_LIT(6.88811208e-2));
    CM_REAL row2 = cm_mad(
        x, cm_mad(x, cm_mad(x, CM_LIT(-1.14523113), CM_LIT(4.86139025e-1)), CM_LIT(2.09379003e-1)),
        CM_LIT(-2.47255331e-1));
    CM_REAL row3 =
        cm_mad(x, cm_mad(x, CM_LIT(4.50029349e-1), CM_LIT(-1.02682857)), CM_LIT(4.86203132e-1));
    CM_REAL row4 = cm_mad(x, CM_LIT(4.25245451e-1), CM_LIT(-4.07359755e-1));
    CM_REAL row5 = CM_LIT(1.17780672e-1);
    CM_REAL sum =
        cm_mad(z, cm_mad(z, cm_mad(z, cm_mad(z, cm_mad(z, row5, row4), row3), row2), row1), row0);
    CM_REAL edge = (CM_LIT(1.0) - u) * (CM_LIT(1.0) + u);
    CM_REAL to_d = (x * edge) * (((CM_LIT(1.0) - y) * (CM_LIT(1.0) + y)) * sum);
    CM_REAL d = cm_mad(u, to_d, u);
    CM_REAL d2 = d * d;
    CM_REAL d4 = d2 * d2;
    CM_REAL a = cm_mad(d2, CM_LIT(-1.20322365e-1), CM_LIT(-2.76401991e-1));
    CM_REAL b = cm_mad(d2, CM_LIT(2.00177488e-1), CM_LIT(-6.55832162e-2));
    CM_REAL c = cm_mad(d2, CM_LIT(3.40142443), CM_LIT(-1.12325569));
    CM_REAL e = cm_mad(d2, CM_LIT(4.68342768), CM_LIT(-5.48090873));
    CM_REAL f = cm_mad(d4, CM_LIT(-1.54301408), e);
    CM_REAL to_p = (CM_LIT(1.0) - d2) * cm_mad(d4, cm_mad(d4, cm_mad(d4, f, c), b), a);
    CM_NAME(cm_seamless_place) r;
    r.excess = cm_mad(to_d, to_p, to_d + to_p);
    r.p = cm_mad(u, r.excess, u);
    return r;
}

/* With k = C1 x + C5 x^5 + C7 x^7 in units of C1 + C5 + C7, t = k / sqrt(1 + (1 - k^2) X / (1 + X)). */
CM_FN CM_NAME(cm_pq) CM_NAME(cm_seamless_inverse)(CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_u = cm_abs(u);
    CM_REAL abs_v = cm_abs(v);
    CM_BOOL wide = cm_at_least(abs_u, abs_v);
    CM_REAL major = CM_SELECT(wide, abs_u, abs_v);
    CM_REAL minor = CM_SELECT(wide, abs_v, abs_u);
    CM_REAL y = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_NAME(cm_seamless_place) r = CM_NAME(cm_seamless_inverse_start)(major, y);
    CM_REAL square = r.p * r.p;
    CM_REAL edge = (CM_LIT(1.0) - r.p) * (CM_LIT(1.0) + r.p);
    r = CM_NAME(cm_seamless_inverse_step)(r, major, y, square, edge,
                                          CM_NAME(cm_seamless_rough)(square, edge));
    square = r.p * r.p;
    edge = (CM_LIT(1.0) - r.p) * (CM_LIT(1.0) + r.p);
#if CM_REAL_BITS >= 64
    r = CM_NAME(cm_seamless_inverse_step)(r, major, y, square, edge,
                                          CM_NAME(cm_seamless_bend)(square, edge));
    square = r.p * r.p;
    edge = (CM_LIT(1.0) - r.p) * (CM_LIT(1.0) + r.p);
#endif
#if CM_REAL_BITS > 64
    r = CM_NAME(cm_seamless_inverse_step)(r, major, y, square, edge,
                                          CM_NAME(cm_seamless_bend)(square, edge));
    square = r.p * r.p;
    edge = (CM_LIT(1.0) - r.p) * (CM_LIT(1.0) + r.p);
    r = CM_NAME(cm_seamless_inverse_step)(r, major, y, square, edge,
                                          CM_NAME(cm_seamless_bend)(square, edge));
    square = r.p * r.p;
    edge = (CM_LIT(1.0) - r.p) * (CM_LIT(1.0) + r.p);
#endif
    CM_REAL m = CM_NAME(cm_seamless_stretch)(square, edge);
    CM_REAL m1 = CM_LIT(1.0) + m;
    CM_REAL x = CM_NAME(cm_quotient)(y, cm_mad(r.excess, m1, m1));
    CM_NAME(cm_seamless_pair) lead = CM_NAME(cm_seamless_lead)(square);
    CM_REAL lack = CM_NAME(cm_seamless_lack)(x, lead.five, lead.seven);
    CM_REAL beside =
        cm_mad((x * x) * lack, CM_LIT(2.0) - lack, (CM_LIT(1.0) - x) * (CM_LIT(1.0) + x));
    CM_REAL h = CM_NAME(cm_quotient)(square * beside, CM_LIT(1.0) + square);
    CM_REAL mm = cm_mad(m, m, CM_LIT(2.0) * m); /* M^2 - 1 */
    /* q = v (1 - lack) / (M sqrt(1 + h)) */
    CM_REAL excess = CM_NAME(cm_inverse_root_excess)(cm_mad(mm, h, mm + h));
    CM_REAL q = CM_NAME(cm_stretch)(minor, cm_mad(-excess, lack, excess - lack));
    q = CM_SELECT(cm_equal(minor, major), r.p, q);
    return CM_NAME(cm_make_pq)(cm_copysign(CM_SELECT(wide, r.p, q), u),
                               cm_copysign(CM_SELECT(wide, q, r.p), v));
}

/* In the octant, with n(x) = C1 + 5 C5 x^4 + 7 C7 x^6 in units of C1 + C5 + C7 and c = 6 / pi,
 *     v_q = M (1 + X) sqrt(omega) / (w^(3/2) n),   S_pv = c / (w^(3/2) v_q),
 *     S_vv = 20 beta x^3 + 42 gamma x^5,   u_q = S_vv v_q,   u_p = S_pv + S_vv v_p,
 * and v_p from the derivative of x by p at constant q. On a diagonal the two octants have the same matrix. */
CM_FN CM_NAME(cm_jacobian) CM_NAME(cm_seamless_jacobian)(CM_REAL p, CM_REAL q, CM_REAL u, CM_REAL v,
                                                         CM_NAME(cm_constants) k)
{
    CM_UNUSED(k);
    CM_REAL abs_p = cm_abs(p);
    CM_REAL abs_q = cm_abs(q);
    CM_BOOL wide = cm_at_least(abs_p, abs_q);
    CM_REAL major = CM_SELECT(wide, abs_p, abs_q);
    CM_REAL minor = CM_SELECT(wide, abs_q, abs_p);
    CM_REAL square = major * major;
    CM_REAL edge = (CM_LIT(1.0) - major) * (CM_LIT(1.0) + major);
    CM_REAL m = CM_LIT(1.0) + CM_NAME(cm_seamless_stretch)(square, edge);
    CM_REAL d = major * m;
    CM_REAL x =
        CM_SELECT(wide, cm_abs(v), cm_abs(u)) / CM_SELECT(cm_less(CM_LIT(0.0), d), d, CM_LIT(1.0));
    CM_REAL x2 = x * x;
    CM_REAL x4 = x2 * x2;
    CM_NAME(cm_seamless_pair) lead = CM_NAME(cm_seamless_lead)(square);
    CM_NAME(cm_seamless_pair) bend = CM_NAME(cm_seamless_bend)(square, edge);
    CM_REAL w1 = CM_LIT(1.0) + square;
    CM_REAL w = w1 + minor * minor;
    CM_REAL omega = CM_LIT(1.0) + CM_LIT(2.0) * square;
    CM_REAL n = (CM_LIT(1.0) - lead.five * (CM_LIT(1.0) - CM_LIT(5.0) * x4)) -
                lead.seven * (CM_LIT(1.0) - CM_LIT(7.0) * (x4 * x2));
    CM_REAL inverse_w = CM_LIT(1.0) / w;
    CM_REAL inverse_n = CM_LIT(1.0) / n;
    CM_REAL root = cm_sqrt(inverse_w);
    CM_REAL v_minor = m * w1 * cm_sqrt(omega) * (inverse_w * root) * inverse_n;
    CM_REAL own = CM_SEAMLESS_AREA * (inverse_w * root) / v_minor;
    CM_REAL share = CM_LIT(1.0) - CM_NAME(cm_seamless_lack)(x, lead.five, lead.seven);
    CM_REAL share_slope = CM_NAME(cm_seamless_lack)(x, lead.five_slope, lead.seven_slope);
    CM_REAL v_major =
        x * (CM_NAME(cm_seamless_rise)(square) -
             m * (share * (CM_LIT(1.0) / omega + square * inverse_w) - share_slope) * inverse_n);
    CM_REAL bent = (x2 * x) * (CM_LIT(20.0) * bend.five + (CM_LIT(42.0) * bend.seven) * x2);
    CM_REAL u_major = own + bent * v_major;
    /* off the diagonal a sign for each of p and q */
    CM_REAL sign = cm_copysign(CM_LIT(1.0), p) * cm_copysign(CM_LIT(1.0), q);
    CM_REAL u_cross = sign * (bent * v_minor);
    CM_REAL v_cross = sign * v_major;
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(wide, u_major, v_minor), CM_SELECT(wide, u_cross, v_cross),
        CM_SELECT(wide, v_cross, u_cross), CM_SELECT(wide, v_minor, u_major));
}

#endif
