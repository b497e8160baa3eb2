* Beale (1955): the largest coefficient rule cycles here. Optimum -0.05 at x4 = 1/25, x6 = 1.
NAME          BEALE
ROWS
 N  COST
 L  R1
 L  R2
 L  R3
COLUMNS
    X4        COST              -.75   R1                 .25
    X4        R2                  .5
    X5        COST               150   R1                 -60
    X5        R2                 -90
    X6        COST              -.02   R1                -.04
    X6        R2                -.02   R3                   1
    X7        COST                 6   R1                   9
    X7        R2                   3
RHS
    RHS       R3                   1
ENDATA
