* Marshall and Suurballe (1969): a smallest cycling example. Optimum -1 (x1 = x3 = 1).
NAME          MARSHALL
ROWS
 N  COST
 L  R1
 L  R2
 L  R3
COLUMNS
    X1        COST               -10   R1                  .5
    X1        R2                  .5   R3                   1
    X2        COST                57   R1                -5.5
    X2        R2                -1.5
    X3        COST                 9   R1                -2.5
    X3        R2                 -.5
    X4        COST                24   R1                   9
    X4        R2                   1
RHS
    RHS       R3                   1
ENDATA
